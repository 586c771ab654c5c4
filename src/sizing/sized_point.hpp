// Points with sizes, and triangles of them that are halved at their longest edge.
#pragma once

#include <array>
#include <utility>

#include <lamina/point.hpp>

namespace lamina::sizing {

/// A point with the size there.
struct SizedPoint {
    Point at;
    double size;
};

/// Returns the squared lengths of the edges a-b, b-c and c-a.
inline std::array<double, 3> squared_edges(const SizedPoint& a, const SizedPoint& b, const SizedPoint& c) {
    return {squared_length(b.at - a.at), squared_length(c.at - b.at), squared_length(a.at - c.at)};
}

/// Renames the corners of a triangle so that c-a is its longest edge, by the results of squared_edges().
inline void rename_longest_edge(SizedPoint& a, SizedPoint& b, SizedPoint& c, const std::array<double, 3>& squared) {
    const auto [ab, bc, ca] = squared;
    if (ab >= bc && ab >= ca)
        std::swap(b, c);
    else if (bc >= ca)
        std::swap(a, b);
}

}  // namespace lamina::sizing
