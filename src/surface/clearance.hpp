// The free room outside of the walls.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/geometry.hpp>

#include "core/box_tree.hpp"

namespace lamina::surface {

/// A search over all walls of a geometry for the walls that face a point of one of them.
class ClearanceSearch {
public:
    explicit ClearanceSearch(const Geometry& geometry);

    /// Returns the distance from a point p of an element to the other elements and to walls of the same element that
    /// face p across a cove. The latter count as at least `min_own_clearance` away. The result is at most
    /// `max_clearance`. `normal` is the outward unit normal at p.
    double clearance(std::size_t element, Point p, Point normal, double min_own_clearance, double max_clearance) const;

private:
    struct WallEdge {
        std::size_t element;
        Point a, b;
    };
    std::vector<WallEdge> edges_;
    core::BoxTree tree_{{}};
};

}  // namespace lamina::surface
