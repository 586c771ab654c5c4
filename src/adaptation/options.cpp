// The table of the options of solution_sizes().
#include <lamina/solution_sizes.hpp>

#include "core/option_rows.hpp"

namespace lamina {

template <>
OptionTable<SolutionSizeOptions> option_rows() {
    OptionTableBuilder<SolutionSizeOptions> table("Sizes");
    table.number("vertices", "N", "number of vertices that the next mesh is to have", numbers_from_to(10, 4e9),
                 member_at(&SolutionSizeOptions::vertices));
    table.number("norm", "P", "p: sizes make the L^p norm of the errors least; larger ones see shocks above all",
                 numbers_from_to(1, 10), member_at(&SolutionSizeOptions::norm));
    table.number("gradation", "G", "growth of sizes per unit of distance in the next mesh, beyond its layers",
                 numbers_from_to(0.01, 1), member_at(&SolutionSizeOptions::gradation));
    table.number("max-change", "F", "sizes are within this factor of the edges of the solution's mesh",
                 numbers_above(1), member_at(&SolutionSizeOptions::max_change));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<SolutionSizeOptions>& option_table();

void validate(const SolutionSizeOptions& options) { require_in_range(option_table<SolutionSizeOptions>(), options); }

}  // namespace lamina
