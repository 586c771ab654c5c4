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
        Point a, b;
        Point middle, normal;  ///< the normal is the outward unit one
    };
    /// The walls of an element.
    struct ElementWalls {
        std::vector<WallEdge> edges;
        core::BoxTree tree{{}};
        std::vector<std::vector<Box>> normals;  ///< boxes round the normals of each group of edges of the tree
    };
    /// Returns the clearance that the walls of the element of p leave, at most `nearest`.
    static double own_clearance(const ElementWalls& walls, Point p, Point normal, double min_own_clearance,
                                double nearest);

    std::vector<ElementWalls> elements_;
    core::BoxTree outlines_{{}};  ///< over the elements
};

}  // namespace lamina::surface
