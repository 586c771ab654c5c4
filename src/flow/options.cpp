// The table of the conditions of solve_flow().
#include <lamina/flow.hpp>

#include <lamina/option_builders.hpp>

namespace lamina {

namespace {

OptionTable<FlowConditions> make_table() {
    OptionTableBuilder<FlowConditions> table("Flow");
    table.number("alpha", "DEG", "direction of the free stream above the x axis, in degrees", numbers_from_to(-90, 90),
                 member_at(&FlowConditions::alpha_deg));
    table.number("reynolds", "RE", "Reynolds number based on the chord; else there are no boundary layers",
                 positive_numbers, member_at(&FlowConditions::reynolds));
    table.number("chord", "C",
                 "chord for coefficients and the Reynolds number, in units of the input; else the extent in x of the "
                 "configuration",
                 positive_numbers, member_at(&FlowConditions::chord));
    return table.take();
}

}  // namespace

const OptionTable<FlowConditions>& flow_option_table() {
    static const OptionTable<FlowConditions> table = make_table();
    return table;
}

void validate(const FlowConditions& conditions) { require_in_range(flow_option_table(), conditions); }

}  // namespace lamina
