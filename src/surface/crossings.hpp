// The search for edges at which outlines cross themselves or each other.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina::surface {

/// An edge of an outline.
struct CrossingEdge {
    std::size_t element;
    std::size_t index;  ///< of its first point
};

/// Returns the edges that meet another one elsewhere than at a common vertex, or that fold back on the next one, each
/// once, in the order of the outlines. Exact (predicates.hpp); O(n log n) in practice.
std::vector<CrossingEdge> find_crossing_edges(const Geometry& geometry);

}  // namespace lamina::surface
