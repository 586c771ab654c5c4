// The table of the options of solution_sizes().
#include <lamina/option_builders.hpp>
#include <lamina/solution_sizes.hpp>

namespace lamina {

namespace {

OptionTable<SolutionSizeOptions> make_table() {
    OptionTableBuilder<SolutionSizeOptions> table("Sizes");
    table.number("vertices", "N", "number of vertices that the next mesh is to have", numbers_from_to(10, 4e9),
                 member_at(&SolutionSizeOptions::vertices));
    table.number("gradation", "G", "growth of sizes per unit of distance in the next mesh, beyond its layers",
                 numbers_from_to(0.01, 1), member_at(&SolutionSizeOptions::gradation));
    table.number("max-change", "F", "sizes are within this factor of the edges of the solution's mesh",
                 numbers_above(1), member_at(&SolutionSizeOptions::max_change));
    return table.take();
}

}  // namespace

const OptionTable<SolutionSizeOptions>& solution_size_option_table() {
    static const OptionTable<SolutionSizeOptions> table = make_table();
    return table;
}

void validate(const SolutionSizeOptions& options) { require_in_range(solution_size_option_table(), options); }

}  // namespace lamina
