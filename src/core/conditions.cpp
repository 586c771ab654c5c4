// The table of the flow conditions, and what follows from them.
#include <lamina/conditions.hpp>

#include <lamina/error.hpp>

#include "core/option_rows.hpp"

namespace lamina {

template <>
OptionTable<FlowConditions> option_rows() {
    OptionTableBuilder<FlowConditions> table("Flow");
    table.number_or_word(
        "chord", "C|ELEMENT",
        "reference chord, in units of the input: what lengths in chords count; the name of an element: "
        "its extent in x; else the extent in x of the configuration; both before --transform turns them",
        positive_numbers, member_at(&FlowConditions::chord), member_at(&FlowConditions::chord_element));
    table.number_or_range("alpha", "DEG|A:B[:STEP]",
                          "angle of attack, in degrees: the flow comes from the left and rises at this angle; nothing "
                          "is turned; a range: "
                          "the mesh serves all angles from A to B, by the flow at each step (1)",
                          numbers_from_to(-90, 90), member_at(&FlowConditions::alpha_deg),
                          member_at(&FlowConditions::alphas));
    table
        .number("reynolds", "RE", "Reynolds number of the free stream, based on the chord", positive_numbers,
                member_at(&FlowConditions::reynolds))
        .excludes = {"velocity", "viscosity"};
    table
        .number("velocity", "V",
                "velocity of the free stream, in units of the input per second; with the viscosity it gives the "
                "Reynolds number",
                positive_numbers, member_at(&FlowConditions::velocity))
        .needs = {"viscosity"};
    table
        .number("viscosity", "NU", "kinematic viscosity, in squared units of the input per second", positive_numbers,
                member_at(&FlowConditions::viscosity))
        .needs = {"velocity"};
    table.number(
        "mach", "M",
        "Mach number of the free stream; makes a case of OpenFOAM one of compressible flow and, with the flow's "
        "help, the mesh finer at shocks",
        positive_numbers, member_at(&FlowConditions::mach));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<FlowConditions>& option_table();

void validate(const FlowConditions& conditions) {
    require_in_range(option_table<FlowConditions>(), conditions);
    const bool velocity = conditions.velocity.has_value(), viscosity = conditions.viscosity.has_value();
    if (velocity && !viscosity) throw OptionError("velocity", "needs viscosity, which is not given");
    if (viscosity && !velocity) throw OptionError("viscosity", "needs velocity, which is not given");
    if (velocity && conditions.reynolds)
        throw OptionError("reynolds", "follows from velocity and viscosity, which are given");
}

std::vector<FlowConditions> conditions_of_angles(const FlowConditions& conditions) {
    if (!conditions.alphas) return {conditions};
    std::vector<FlowConditions> all;
    for (const double alpha : values_of(*conditions.alphas)) {
        all.push_back(conditions);
        all.back().alpha_deg = alpha;
        all.back().alphas.reset();
    }
    return all;
}

ReferenceConditions reference_conditions(const FlowConditions& conditions, const Box& bodies) {
    constexpr double least_slope = 1e-3;  // of width over height: upright plates have no chord
    validate(conditions);
    if (!conditions.chord && !conditions.chord_element.empty())
        throw OptionError("chord", "'" + conditions.chord_element + "' is no number, and there is no element");
    if (!conditions.chord && !(bodies.width() > least_slope * bodies.height()))
        throw OptionError("chord", "has to be given, as --chord C: the configuration has no extent in x");
    ReferenceConditions reference{.chord = conditions.chord.value_or(bodies.width()),
                                  .alpha_deg = conditions.alpha_deg,
                                  .reynolds = conditions.reynolds,
                                  .mach = conditions.mach};
    if (conditions.velocity) reference.reynolds = *conditions.velocity * reference.chord / *conditions.viscosity;
    return reference;
}

}  // namespace lamina
