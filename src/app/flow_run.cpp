#include "app/flow_run.hpp"

#include <utility>

namespace lamina::app {

Geometry in_row(Geometry geometry, const CaseOptions& options) {
    const FarFieldOptions& domain = options.far_field;
    if (!domain.pitch) return geometry;
    const double chord = reference_conditions(options.conditions, reference_box(geometry)).chord;
    return blade_row(std::move(geometry), in_units(*domain.pitch, chord), domain.stagger_deg);
}

FoundFlow find_flow(Geometry geometry, const CaseOptions& options) {
    geometry = in_row(std::move(geometry), options);
    const double chord = reference_conditions(options.conditions, reference_box(geometry)).chord;
    const FlowWalls walls = flow_walls(geometry, options);
    return find_flow(geometry, prepare_surfaces(geometry, options.surface, chord), options.conditions, walls);
}

FoundFlow find_flow(const Geometry& given, const Geometry& prepared, const FlowConditions& conditions,
                    const FlowWalls& walls) {
    FoundFlow found{.flow = solve_flow(prepared, conditions, walls),
                    .has_layers = reference_conditions(conditions, reference_box(given)).reynolds.has_value()};
    if (is_beyond_critical(found.flow, conditions)) {
        found.compressible = solve_compressible_flow(given, conditions);
    } else if (conditions.mach) {
        found.flow = with_compressed_pressures(std::move(found.flow), *conditions.mach);
    }
    return found;
}

}  // namespace lamina::app
