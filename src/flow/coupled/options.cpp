// The table of the options of transition.
#include <lamina/coupled_flow.hpp>

#include "core/option_rows.hpp"

namespace lamina {

template <>
OptionTable<TransitionOptions> option_rows() {
    OptionTableBuilder<TransitionOptions> table("Transition");
    table.number(
        "ncrit", "N",
        "exponent of the most amplified wave at which boundary layers become turbulent: 9 in smooth, 4 to 6 in "
        "rough streams",
        numbers_from_to(0.5, 30), member_at(&TransitionOptions::critical_exponent));
    table.number("trip", "X",
                 "share of each element's extent in x where boundary layers become turbulent at the latest, on "
                 "both sides",
                 numbers_from_to(0, 1), member_at(&TransitionOptions::trip));
    table.number("trip-lower", "X", "the same on the lower side, in place of --trip", numbers_from_to(0, 1),
                 member_at(&TransitionOptions::trip_lower));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<TransitionOptions>& option_table();

void validate(const TransitionOptions& options) { require_in_range(option_table<TransitionOptions>(), options); }

}  // namespace lamina
