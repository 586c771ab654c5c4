#include "app/flow_run.hpp"

#include <utility>

namespace lamina::app {

FoundFlow find_flow(Geometry geometry, const CaseOptions& options) {
    const FlowConditions& conditions = options.conditions;
    if (const FarFieldOptions& domain = options.far_field; domain.pitch)
        geometry = blade_row(geometry,
                             in_units(*domain.pitch, reference_conditions(conditions, reference_box(geometry)).chord),
                             domain.stagger_deg);
    const ReferenceConditions reference = reference_conditions(conditions, reference_box(geometry));
    const FlowWalls walls = flow_walls(geometry, options);
    FoundFlow found{.flow = solve_flow(prepare_surfaces(geometry, options.surface, reference.chord), conditions, walls),
                    .has_layers = reference.reynolds.has_value()};
    if (is_beyond_critical(found.flow, conditions)) {
        found.compressible = solve_compressible_flow(geometry, conditions);
    } else if (conditions.mach) {
        found.flow = with_compressed_pressures(std::move(found.flow), *conditions.mach);
    }
    return found;
}

}  // namespace lamina::app
