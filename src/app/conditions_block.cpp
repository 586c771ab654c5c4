#include "app/conditions_block.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>

#include "app/options.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

/// A number of the flow.
struct FlowFact {
    std::string key;    ///< in the report
    std::string label;  ///< in the summary
    double value;
    std::string unit;  ///< in the summary
    std::string source;
    bool is_default = false;  ///< whether the summary leaves it out
    std::string range{};      ///< that the value is one of; empty: there is none
};

/// Say where the wakes and spacings of the flow come from.
const char* wake_source(const FlowWake& wake) {
    return wake.separated
               ? "envelope of both shear layers, from where the flow leaves the wall"
               : "streamline of the panel method, with 0.8 of its lift; as wide as the boundary layers, Head, "
                 "spreading like a plane wake, Schlichting";
}
constexpr const char* spacing_source =
    "change of the pressure coefficient of the panel method, or first height at the corners of a base";
const char* shock_source(const FlowShock& shock) {
    return shock.has_layers ? "compressible flow with boundary layers"
                            : "compressible flow without friction, whose shock is moved forward by 0.04 chords for the "
                              "boundary layer";
}

/// A length in force.
struct LengthFact {
    std::string key;    ///< in the report
    std::string label;  ///< in the summary
    Length length;
    std::string source;
    std::string element{};  ///< that it holds on; empty: on all
};

/// Returns where the value of an option comes from.
std::string source_of(const MeshCase& mesh_case, const std::string& option) {
    if (std::find(mesh_case.given.begin(), mesh_case.given.end(), option) != mesh_case.given.end()) return "given";
    const Option<MeshCase>& row = find_row(mesh_options(), option);
    if (row.get(mesh_case) == row.get(MeshCase{})) return "default";
    return "preset " + (mesh_case.preset == automatic_preset ? "rans" : mesh_case.preset);
}

std::vector<FlowFact> flow_facts(const MeshCase& mesh_case, const MeshResult& result) {
    const ReferenceConditions& flow = result.conditions;
    const FlowConditions& options = mesh_case.options.conditions;
    std::vector<FlowFact> facts{
        {"chord", "chord", flow.chord, "", chord_source(options)},
        {"alpha_deg", "angle of attack", flow.alpha_deg, " deg", source_of(mesh_case, "alpha"), flow.alpha_deg == 0}};
    if (options.alphas) {
        facts.back().is_default = false;
        facts.back().range = range_text(*options.alphas);
    }
    if (flow.reynolds)
        facts.push_back({"reynolds", "Reynolds number", *flow.reynolds, "",
                         options.reynolds ? "given" : "velocity x chord / viscosity"});
    if (flow.mach) facts.push_back({"mach", "Mach number", *flow.mach, "", "given"});
    if (result.y_plus) facts.push_back({"y_plus", "y+", result.y_plus->y_plus, "", source_of(mesh_case, "y-plus")});
    return facts;
}

/// Returns the first height of each element, or one for all where they have the same.
std::vector<LengthFact> first_heights(const MeshCase& mesh_case, const MeshResult& result) {
    const char *key = "first_height", *label = "first layer";
    const LayerOptions& options = mesh_case.options.layer;
    if (const auto* given = std::get_if<Length>(&options.first_height))
        return {{key, label, *given, source_of(mesh_case, "first-height")}};
    if (!result.flow || result.flow->estimated)
        return {
            {key, label, input_units(result.first_heights.front()), "from y+ on a flat plate: White, Fluid Mechanics"}};
    std::vector<LengthFact> facts;
    for (std::size_t e = 0; e < result.first_heights.size(); ++e) {
        const ElementFlow& element = result.flow->elements[e];
        if (!result.decisions.angles.empty()) {
            facts.push_back({key, label, input_units(result.first_heights[e]),
                             "from y+ and the largest skin friction at all angles of attack", element.name});
            continue;
        }
        if (!result.decisions.frictions.empty()) {
            facts.push_back({key, label, input_units(result.first_heights[e]),
                             fmt::format("from y+ and the largest skin friction times density, {:.4g}, of compressible "
                                         "flow: Green",
                                         result.decisions.frictions[e]),
                             element.name});
            continue;
        }
        const double friction = largest_skin_friction(element);
        const bool at_corners = friction > largest_on_walls(element, &FlowPoint::skin_friction);
        facts.push_back(
            {key, label, input_units(result.first_heights[e]),
             fmt::format("from y+ and the largest skin friction, {:.4g}: {}", friction,
                         at_corners ? "of the flow that turns round the corners of the base" : "Thwaites, Head"),
             element.name});
    }
    if (facts.size() == 1) facts.front().element.clear();
    return facts;
}

std::vector<LengthFact> length_facts(const MeshCase& mesh_case, const MeshResult& result) {
    const CaseOptions& options = mesh_case.options;
    std::vector<LengthFact> facts;
    const auto add = [&](const char* option, const char* label, const std::optional<Length>& length) {
        if (length) facts.push_back({option_key(option), label, *length, source_of(mesh_case, option)});
    };
    if (options.layer.enabled) {
        for (const LengthFact& height : first_heights(mesh_case, result)) facts.push_back(height);
        add("thickness", "thickness", options.layer.thickness);
    }
    if (result.flow)
        facts.push_back({"boundary_layer", "boundary layer",
                         input_units(largest_on_walls(*result.flow, &FlowPoint::thickness)),
                         result.flow->estimated ? "largest thickness on flat plates" : "largest thickness: Head"});
    if (const double least = result.decisions.least_thickness; least > 0)
        facts.push_back({"least_thickness", "layer up to", input_units(least),
                         "largest of the heights that layers reach at least: from the boundary layer's thickness"});
    add("smooth", "smooth", options.surface.smooth);
    add("wall-size", "wall size", options.sizing.wall_size);
    add("far-size", "far size", options.sizing.far_size);
    if (options.far_field.shape != FarFieldShape::outline) add("far-field", "far field", options.far_field.size);
    const std::vector<WakeOptions>& wakes = options.sizing.wakes;
    for (std::size_t i = 0; i < wakes.size(); ++i) {
        const std::string number = i == 0 ? "" : fmt::format("_{}", i + 1);
        facts.push_back({"wake_length" + number, "wake length", wakes[i].length, source_of(mesh_case, "wake")});
        if (const auto& size = wakes[i].size)
            facts.push_back({"wake_size" + number, "wake size", *size, source_of(mesh_case, "wake")});
    }
    return facts;
}

std::string wakes_summary(const MeshResult& result) {
    const double chord = result.conditions.chord;
    const std::vector<FlowWake>& wakes = result.decisions.wakes;
    std::string text;
    for (std::size_t i = 0; i < wakes.size(); ++i) {
        const FlowWake& wake = wakes[i];
        const std::string layers =
            wake.with_layers > 0 ? fmt::format(", with layers over {:.4g} chords", wake.with_layers / chord) : "";
        text += summary_line(
            "wake", fmt::format("{} of {}, behind {}: {:.4g} chords long{}, {:.3g} to {:.3g} chords wide ({})", i + 1,
                                wakes.size(), wake.element, wake.length / chord, layers, wake.first_width / chord,
                                wake.last_width / chord, wake_source(wake)));
    }
    return text;
}

std::string spacings_summary(const MeshResult& result) {
    const double chord = result.conditions.chord;
    std::string text;
    for (const FlowSpacing& spacing : result.decisions.spacings)
        text += summary_line(
            "wall", fmt::format("spacings on {} down to {:.3g} chords, at ({:.6g}, {:.6g}) ({})", spacing.element,
                                spacing.smallest / chord, spacing.at.x, spacing.at.y, spacing_source));
    return text;
}

std::string shocks_summary(const MeshResult& result) {
    std::string text;
    for (const FlowShock& shock : result.decisions.shocks)
        text +=
            summary_line("shock", fmt::format("on {}, expected at ({:.4g}, {:.4g}), Mach {:.3g} ahead of it, {:.2g} "
                                              "chords high ({})",
                                              shock.element, shock.at.x, shock.at.y, shock.mach_ahead,
                                              shock.height / result.conditions.chord, shock_source(shock)));
    return text;
}

/// Returns a table of what the flow at each angle of a range would have asked for alone.
std::string angles_summary(const MeshResult& result) {
    if (result.decisions.angles.empty()) return "";
    const double chord = result.conditions.chord;
    std::string text = "one mesh for all angles of attack; alone, in chords, each would have asked for\n";
    text += fmt::format("  {:>8} {:>8} {:>13} {:>13} {:>13}\n", "alpha", "lift", "first height", "layer up to",
                        "wall spacing");
    for (const AngleDecisions& at : result.decisions.angles)
        text += fmt::format("  {:>8g} {:>8.4f} {:>13.4g} {:>13.4g} {:>13.4g}{}\n", at.alpha_deg, at.lift,
                            at.first_height / chord, at.least_thickness / chord, at.smallest_spacing / chord,
                            at.separated ? "  separated" : "");
    return text;
}

}  // namespace

std::string chord_source(const FlowConditions& conditions) {
    if (conditions.chord) return "given";
    return "extent in x" + (conditions.chord_element.empty() ? "" : " of " + conditions.chord_element);
}

std::string chord_line(const FlowConditions& conditions, const Geometry& geometry) {
    try {
        const double chord = reference_conditions(conditions, geometry).chord;
        return fmt::format("reference chord {:.6g} ({})\n", chord, chord_source(conditions));
    } catch (const OptionError& error) {
        if (!conditions.chord_element.empty()) throw;
        return fmt::format("reference chord {}\n", error.reason());
    }
}

Json both_units(double length, double chord) { return {{"chords", length / chord}, {"units", length}}; }

std::string conditions_summary(const MeshCase& mesh_case, const MeshResult& result) {
    std::string flow, lengths;
    for (const FlowFact& fact : flow_facts(mesh_case, result)) {
        if (fact.is_default) continue;
        const std::string value = fmt::format("{:.6g}", fact.value);
        flow += fmt::format("{}{} {}{} ({})", flow.empty() ? "" : ", ", fact.label,
                            fact.range.empty() ? value : fact.range, fact.unit, fact.source);
        if (!fact.range.empty()) flow += fmt::format(", {} where one is needed", value);
    }
    const double chord = result.conditions.chord;
    for (const LengthFact& fact : length_facts(mesh_case, result))
        lengths +=
            summary_line(fact.label, fmt::format("{:.4g} chords, {:.4g} units of the input{} ({})",
                                                 in_chords(fact.length, chord), in_units(fact.length, chord),
                                                 fact.element.empty() ? "" : " on " + fact.element, fact.source));
    return "conditions: " + flow + "\n" + lengths + wakes_summary(result) + spacings_summary(result) +
           shocks_summary(result) + angles_summary(result);
}

Json conditions_report(const MeshCase& mesh_case, const MeshResult& result) {
    Json report;
    for (const FlowFact& fact : flow_facts(mesh_case, result))
        report[fact.key] = {{"value", fact.value}, {"source", fact.source}};
    const double chord = result.conditions.chord;
    for (const LengthFact& fact : length_facts(mesh_case, result)) {
        const Json length = {{"chords", in_chords(fact.length, chord)},
                             {"units", in_units(fact.length, chord)},
                             {"source", fact.source}};
        if (fact.element.empty()) {
            report[fact.key] = length;
        } else {
            report[fact.key]["elements"].push_back(length);
            report[fact.key]["elements"].back()["element"] = fact.element;
        }
    }
    for (const FlowWake& wake : result.decisions.wakes)
        report["wakes"].push_back({{"element", wake.element},
                                   {"length", both_units(wake.length, chord)},
                                   {"first_width", both_units(wake.first_width, chord)},
                                   {"last_width", both_units(wake.last_width, chord)},
                                   {"with_layers", both_units(wake.with_layers, chord)},
                                   {"source", wake_source(wake)}});
    for (const FlowSpacing& spacing : result.decisions.spacings)
        report["wall_spacings"].push_back({{"element", spacing.element},
                                           {"smallest", both_units(spacing.smallest, chord)},
                                           {"at", {spacing.at.x, spacing.at.y}},
                                           {"source", spacing_source}});
    for (const FlowShock& shock : result.decisions.shocks)
        report["shocks"].push_back({{"element", shock.element},
                                    {"at", {shock.at.x, shock.at.y}},
                                    {"mach_ahead", shock.mach_ahead},
                                    {"height", both_units(shock.height, chord)},
                                    {"source", shock_source(shock)}});
    for (const AngleDecisions& at : result.decisions.angles)
        report["angles"].push_back({{"alpha_deg", at.alpha_deg},
                                    {"CL", at.lift},
                                    {"first_height", both_units(at.first_height, chord)},
                                    {"least_thickness", both_units(at.least_thickness, chord)},
                                    {"smallest_spacing", both_units(at.smallest_spacing, chord)},
                                    {"separated", at.separated}});
    return report;
}

}  // namespace lamina::app
