// Walks along closed outlines.
#pragma once

#include <cstddef>

namespace lamina::layers {

/// A walk from a vertex of a closed outline, in either direction.
struct OutlineWalk {
    std::size_t size;   ///< number of the outline's vertices
    std::size_t start;  ///< index of the vertex
    bool ahead;         ///< whether it follows the outline's direction

    /// Returns the vertex after so many steps, up to `size` of them.
    std::size_t vertex(std::size_t steps) const { return (ahead ? start + steps : start + size - steps) % size; }
    /// Returns the edge, from the vertex of its number to the next one, that the step with this number runs along; the
    /// first step is 1.
    std::size_t edge(std::size_t step) const { return vertex(ahead ? step - 1 : step); }
};

}  // namespace lamina::layers
