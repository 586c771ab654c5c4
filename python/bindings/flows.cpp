// The flow round bodies before there is a mesh.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "app/flow_run.hpp"
#include "app/polar.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "facts.hpp"
#include "interruption.hpp"
#include "request.hpp"
#include "sections.hpp"

namespace lamina::python {

namespace {

/// Returns the array of what f(p) is at all points of a side.
template <class Scalar, class Points, class F>
auto array_along(const Points& side, F&& f) {
    std::vector<std::decay_t<decltype(f(side[0]))>> values;
    for (const auto& p : side) values.push_back(f(p));
    return owning_array<Scalar>(std::move(values));
}

/// Adds the arrays that both kinds of flow have.
template <class Points>
nb::dict common_arrays(const Points& side) {
    using P = typename Points::value_type;
    nb::dict arrays;
    arrays["points"] = array_along<double>(side, [](const P& p) { return p.at; });
    arrays["cp"] = array_along<double>(side, [](const P& p) { return p.pressure_coefficient; });
    arrays["momentum"] = array_along<double>(side, [](const P& p) { return p.momentum; });
    arrays["displacement"] = array_along<double>(side, [](const P& p) { return p.displacement; });
    arrays["skin_friction"] = array_along<double>(side, [](const P& p) { return p.skin_friction; });
    return arrays;
}

nb::dict side_of(const std::vector<FlowPoint>& side) {
    nb::dict arrays = common_arrays(side);
    arrays["arc_length"] = array_along<double>(side, [](const FlowPoint& p) { return p.s; });
    arrays["speed"] = array_along<double>(side, [](const FlowPoint& p) { return p.speed; });
    arrays["thickness"] = array_along<double>(side, [](const FlowPoint& p) { return p.thickness; });
    arrays["shape"] = array_along<double>(side, [](const FlowPoint& p) { return p.shape; });
    arrays["state"] =
        array_along<std::uint8_t>(side, [](const FlowPoint& p) { return static_cast<std::uint8_t>(p.state); });
    return arrays;
}

nb::dict side_of(const CompressibleSide& side) {
    nb::dict arrays = common_arrays(side.points);
    arrays["mach"] = array_along<double>(side.points, [](const CompressibleWallPoint& p) { return p.mach; });
    nb::list shocks;
    for (const WallShock& shock : side.shocks) {
        nb::dict facts;
        facts["at"] = nb::make_tuple(shock.at.x, shock.at.y);
        facts["position"] = shock.position;
        facts["mach_ahead"] = shock.mach_ahead;
        facts["mach_behind"] = shock.mach_behind;
        shocks.append(facts);
    }
    arrays["shocks"] = shocks;
    return arrays;
}

/// Returns (name, upper side, lower side) for each body.
template <class Elements>
nb::list elements_of(const Elements& elements) {
    nb::list result;
    for (const auto& element : elements)
        result.append(nb::make_tuple(element.name, side_of(element.upper), side_of(element.lower)));
    return result;
}

nb::dict flow_facts(const Flow& flow) {
    nb::dict facts;
    facts["alpha"] = flow.alpha_deg;
    facts["chord"] = flow.chord;
    facts["lift"] = flow.lift;
    facts["elements"] = elements_of(flow.elements);
    facts["warnings"] = warnings_of(flow.warnings);
    return facts;
}

nb::dict flow_facts(CompressibleFlow flow) {
    nb::dict facts;
    facts["alpha"] = flow.alpha_deg;
    facts["chord"] = flow.chord;
    facts["lift"] = flow.lift;
    facts["elements"] = elements_of(flow.elements);
    facts["mach"] = flow.mach;
    facts["drag"] = flow.drag;
    facts["viscous_drag"] = flow.viscous_drag;
    facts["wave_drag"] = flow.wave_drag;
    facts["has_layers"] = flow.has_layers;
    facts["converged"] = flow.converged;
    facts["points"] = owning_array<double>(std::move(flow.points));
    facts["triangles"] = owning_array<std::uint32_t>(std::move(flow.triangles));
    facts["mach_numbers"] = owning_array<double>(std::move(flow.mach_numbers));
    return facts;
}

using OptionValues = std::vector<std::pair<std::string, OptionValue>>;

/// Returns the options of a flow by the names of rows of the table of TransitionOptions.
TransitionOptions transition_of(const OptionValues& values) {
    TransitionOptions transition;
    for (const auto& [name, value] : values) find_row(option_table<TransitionOptions>(), name).set(transition, value);
    return transition;
}

/// Returns the polar of `lamina flow`, as the text of polar.json.
std::string find_polar(const nb::list& given, const OptionValues& values, const OptionValues& of_transition) {
    const CaseOptions options = make_request(values).options;
    const TransitionOptions transition = transition_of(of_transition);
    const std::vector<Section> sections = sections_of(given);
    std::string text;
    run_unlocked([&] {
        const app::FlowPolar polar = app::flow_polar(geometry_of(sections, options.geometry), options, transition);
        text = app::polar_text("polar.json", polar.conditions, polar.rows);
    });
    return text;
}

/// Returns the flow that `lamina flow` finds, with the options of meshes, and those of TransitionOptions by their
/// names.
nb::dict find_flow(const nb::list& given, const OptionValues& values, const OptionValues& of_transition) {
    const CaseOptions options = make_request(values).options;
    const TransitionOptions transition = transition_of(of_transition);
    const std::vector<Section> sections = sections_of(given);
    app::FoundFlow found;
    run_unlocked([&] { found = app::find_flow(geometry_of(sections, options.geometry), options, transition); });
    nb::dict facts = found.compressible ? flow_facts(std::move(*found.compressible)) : flow_facts(found.flow);
    if (!found.compressible) {
        facts["mach"] = options.conditions.mach ? nb::cast(*options.conditions.mach) : nb::none();
        facts["has_layers"] = found.has_layers;
        facts["moment"] = found.forces.moment;
        if (found.transitions.size() == 1) {
            facts["transition_upper"] = found.transitions.front().upper;
            facts["transition_lower"] = found.transitions.front().lower;
        }
        if (found.loose) facts["converged"] = false;
        if (found.has_layers && !found.flow.estimated) {
            facts["drag"] = found.forces.drag;
            facts["viscous_drag"] = found.forces.drag;
        }
    }
    return facts;
}

}  // namespace

void add_flows(nb::module_& module) {
    module.def("flow", &find_flow);
    module.def("polar", &find_polar);
}

}  // namespace lamina::python
