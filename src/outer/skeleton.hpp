// The first lines between pieces: near-body box and rings of trapezoids.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <lamina/decoupling.hpp>

namespace lamina::outer {

/// Points and directed edges of the subdivision while it grows; an edge has the region on its left.
struct Skeleton {
    std::vector<Point> points;
    std::vector<Segment> edges;

    VertexId add_point(Point p) {
        points.push_back(p);
        return VertexId{points.size() - 1};
    }
    /// Edges along a chain of vertices, in its direction and, for separators, in the other one as well.
    void add_chain(std::span<const VertexId> chain, bool both_directions);
};

/// Counter-clockwise corners of a box, from the lower left one.
std::array<Point, 4> corners_of(const Box& box);

/// One ring of trapezoids between the boxes at parameters `inner` and `outer`, 0 being the near-body box and 1 the far
/// field, with `per_side` of them on each of its four sides.
struct Ring {
    double inner, outer;
    std::size_t per_side;
};

/// Rings from near_body to far_field such that no trapezoid has more than about `pieces_target` triangles.
/// Trapezoids are halved along their longer extent as measured in edge lengths; powers of two keep junctions of
/// neighbouring rings in common. None where the near-body box is the far field.
std::vector<Ring> plan_rings(const Box& near_body, const Box& far_field, const SizeField& size, double pieces_target);

/// Adds near-body box, rings and far field to the skeleton. The far field's edges.
std::vector<Segment> add_rings(Skeleton& skeleton, std::span<const Ring> rings, const Box& near_body,
                               const Box& far_field, const SizeField& size, SeparatorRule rule);

}  // namespace lamina::outer
