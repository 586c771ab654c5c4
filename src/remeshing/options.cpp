// The table of the options of remesh().
#include <lamina/remesh.hpp>

#include "core/option_rows.hpp"

namespace lamina {

template <>
OptionTable<RemeshOptions> option_rows() {
    OptionTableBuilder<RemeshOptions> table("Remeshing");
    table.flag("divide-borders", "divides and merges edges on straight lines of the boundary, too", true,
               member_at(&RemeshOptions::divide_borders));
    table.number("vertices", "N", "scales the metric to ask for about so many vertices beyond the layer",
                 numbers_from_to(3, 4e9), member_at(&RemeshOptions::vertices));
    table.number("gradation", "G", "largest growth of sizes per unit of distance; else as in the metric",
                 numbers_from_to(0.01, 10), member_at(&RemeshOptions::gradation));
    table.number("max-ratio", "R", "largest ratio of the two lengths that the metric asks for at a place",
                 numbers_from_to(1, 1e6), member_at(&RemeshOptions::max_ratio));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<RemeshOptions>& option_table();

void validate(const RemeshOptions& options) { require_in_range(option_table<RemeshOptions>(), options); }

}  // namespace lamina
