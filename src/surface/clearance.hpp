// All walls of a geometry, searched for the free room outside of one of them.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/geometry.hpp>

#include "core/box_tree.hpp"

namespace lamina::surface {

class Walls {
public:
    explicit Walls(const Geometry& geometry);

    /// Returns the distance from a point p of an element to the other elements, or to what faces p across a cove of the
    /// same element; the latter counts as `least_own` at least. The result is at most `most`. `normal` is the outward
    /// unit normal at p.
    double room(std::size_t element, Point p, Point normal, double least_own, double most) const;

private:
    struct Edge {
        std::size_t element;
        Point a, b;
    };
    std::vector<Edge> edges_;
    core::BoxTree tree_{{}};
    std::vector<std::vector<double>> zeros_;  ///< as values of the tree's items
};

}  // namespace lamina::surface
