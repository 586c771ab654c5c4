#include "app/flow_run.hpp"

#include <utility>

#include <lamina/error.hpp>

namespace lamina::app {

namespace {

/// Refuses options of transition for layers that are not solved together with the flow.
void require_default(const TransitionOptions& transition) {
    const TransitionOptions usual;
    const char* name = transition.critical_exponent != usual.critical_exponent ? "ncrit"
                       : transition.trip                                       ? "trip"
                                                                               : "trip-lower";
    if (transition != usual)
        throw OptionError(name, "needs a Reynolds number of 1e4 or more, at most five elements, and no row of blades");
}

/// Puts flows that were solved with their layers in the places of those that are not compressible.
void add_coupled_flows(std::vector<FoundFlow>& found, std::vector<CoupledFlow> flows) {
    auto next = flows.begin();
    for (FoundFlow& flow : found) {
        if (flow.compressible) continue;
        flow.flow = std::move(next->flow);
        flow.forces = next->forces;
        flow.loose = !next->converged;
        flow.transitions = std::move(next->transitions);
        ++next;
    }
}

/// Gives a flow the pressures, lift and moment of compressible flow.
void compress(FoundFlow& found, double mach) {
    found.flow = with_compressed_pressures(std::move(found.flow), mach);
    const FlowForces forces = flow_forces(found.flow);
    found.forces.lift = forces.lift;
    found.forces.moment = forces.moment;
}

}  // namespace

bool is_undisplaced(const FoundFlow& found) {
    return found.has_layers && !found.is_coupled() && !found.compressible && !found.flow.estimated;
}

Geometry in_row(Geometry geometry, const CaseOptions& options) {
    const FarFieldOptions& domain = options.far_field;
    if (!domain.pitch) return geometry;
    const double chord = reference_conditions(options.conditions, geometry).chord;
    return blade_row(std::move(geometry), in_units(*domain.pitch, chord), domain.stagger_deg);
}

FoundFlow find_flow(Geometry geometry, const CaseOptions& options, const TransitionOptions& transition) {
    return std::move(find_flows(std::move(geometry), options, {&options.conditions, 1}, transition).front());
}

std::vector<FoundFlow> find_flows(Geometry geometry, const CaseOptions& options,
                                  std::span<const FlowConditions> conditions, const TransitionOptions& transition) {
    if (options.far_field.symmetry)
        throw OptionError("symmetry", "is for meshes: the flow takes whole bodies, and ground as a wall");
    geometry = in_row(std::move(geometry), options);
    const ReferenceConditions reference = reference_conditions(options.conditions, geometry);
    const FlowWalls walls = flow_walls(geometry, options.conditions, options.far_field);
    const Geometry prepared = prepare_surfaces(geometry, options.surface, reference.chord);
    const bool coupled = can_be_coupled(prepared, reference, walls);
    if (!coupled) require_default(transition);
    std::vector<FoundFlow> found;
    std::vector<FlowConditions> to_couple;
    for (const FlowConditions& each : conditions) {
        FoundFlow& flow = found.emplace_back();
        flow.has_layers = reference.reynolds.has_value();
        if (!coupled || each.mach) flow.flow = solve_flow(prepared, each, walls);
        if (each.mach && is_beyond_critical(flow.flow, each))
            flow.compressible = solve_compressible_flow(geometry, each);
        else if (coupled)
            to_couple.push_back(each);
        else
            flow.forces = flow_forces(flow.flow);
    }
    if (!to_couple.empty()) add_coupled_flows(found, solve_coupled_flow(prepared, to_couple, transition, walls));
    if (reference.mach)
        for (FoundFlow& flow : found)
            if (!flow.compressible) compress(flow, *reference.mach);
    return found;
}

}  // namespace lamina::app
