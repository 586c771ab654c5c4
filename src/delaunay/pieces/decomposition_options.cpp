// The table of the options of triangulation in pieces.
#include <lamina/delaunay.hpp>
#include <lamina/option_builders.hpp>

namespace lamina {

namespace {

OptionTable<DecompositionOptions> make_decomposition_table() {
    OptionTableBuilder<DecompositionOptions> table("Layer");
    table.count("decomposition-depth", "N", "largest number of cuts on the way to a piece of the layer",
                numbers_from_to(0, 24), member_at(&DecompositionOptions::depth));
    table.count("leaf-vertices", "N", "pieces of the layer with at most this many vertices are not cut further",
                numbers_from_to(1, 1e9), member_at(&DecompositionOptions::leaf_vertices));
    return table.take();
}

}  // namespace

const OptionTable<DecompositionOptions>& decomposition_option_table() {
    static const OptionTable<DecompositionOptions> table = make_decomposition_table();
    return table;
}

void validate(const DecompositionOptions& options) { require_in_range(decomposition_option_table(), options); }

}  // namespace lamina
