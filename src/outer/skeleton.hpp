// The first lines between pieces: near-body box and rings of trapezoids.
#pragma once

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

/// One ring of trapezoids between the boxes at parameters `inner` and `outer`, 0 being the near-body box and 1 the
/// outermost one, with `per_side` of them on each of its four sides.
struct Ring {
    double inner, outer;
    std::size_t per_side;
};

/// Rings from near_body to `outermost` such that no trapezoid has more than about `pieces_target` triangles.
/// Trapezoids are halved along their longer extent as measured in edge lengths; powers of two keep junctions of
/// neighbouring rings in common. None where the near-body box is the outermost one.
std::vector<Ring> plan_rings(const Box& near_body, const Box& outermost, const SizeField& size, double pieces_target);

/// Adds near-body box, rings and outermost box to the skeleton. The edges of the outermost box, with the region on
/// their left; where something lies beyond it, they stand in the other direction as well.
std::vector<Segment> add_rings(Skeleton& skeleton, std::span<const Ring> rings, const Box& near_body,
                               const Box& outermost, const SizeField& size, SeparatorRule rule, bool something_beyond);

/// Adds the outline of a far field that is no box to the skeleton. Its edges, with the region on their left.
std::vector<Segment> add_outline(Skeleton& skeleton, const DecouplingOptions& options, const SizeField& size);

}  // namespace lamina::outer
