// The direction in which a closed polygon runs.
#pragma once

#include <cstddef>

#include <lamina/point.hpp>
#include <lamina/predicates.hpp>

namespace lamina::core {

/// Returns the index of the lexicographically smallest of n vertices, and the first one of equals; vertex(i) returns
/// vertex i. Precondition: n > 0.
template <class Vertex>
std::size_t smallest_vertex(std::size_t n, Vertex&& vertex) {
    std::size_t smallest = 0;
    for (std::size_t i = 1; i < n; ++i)
        if (lexicographically_less(vertex(i), vertex(smallest))) smallest = i;
    return smallest;
}

/// Returns a positive number if a simple polygon of n vertices runs counter-clockwise, and a negative one if it runs
/// clockwise. At its smallest vertex it turns in the direction in which it goes round. Exact.
template <class Vertex>
double polygon_orientation(std::size_t n, Vertex&& vertex) {
    const std::size_t i = smallest_vertex(n, vertex);
    return orient2d(vertex((i + n - 1) % n), vertex(i), vertex((i + 1) % n));
}

}  // namespace lamina::core
