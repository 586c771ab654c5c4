// The ranges of the options of triangulation in pieces.
#include <lamina/delaunay.hpp>

#include "core/option_builders.hpp"

namespace lamina {

void validate(const DecompositionOptions& options) {
    require_in_range(numbers_from_to(0, 24), options.depth, "depth");
    require_in_range(numbers_from_to(1, 1e9), static_cast<double>(options.leaf_vertices), "leaf_vertices");
}

}  // namespace lamina
