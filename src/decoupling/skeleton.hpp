// The first lines between pieces: near-body box and rings of trapezoids.
#pragma once

#include <span>
#include <vector>

#include <lamina/decoupling.hpp>

#include "decoupling/separators.hpp"

namespace lamina::decoupling {

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

/// The boxes between which rings lie.
struct RingBoxes {
    Box near_body, outermost;

    /// Returns the box at a parameter from 0, the near-body box, to 1, the outermost box.
    Box at(double t) const {
        return {near_body.lower + t * (outermost.lower - near_body.lower),
                near_body.upper + t * (outermost.upper - near_body.upper)};
    }
};

/// One ring of trapezoids between the boxes at the parameters `inner` and `outer`, with `per_side` of them on each of
/// its four sides.
struct Ring {
    double inner, outer;
    std::size_t per_side;
};

/// Returns rings from the near-body box to the outermost box such that no trapezoid has more than about `pieces_target`
/// triangles. Trapezoids are halved along their longer extent as measured in edge lengths; powers of two keep junctions
/// of neighbouring rings in common. There is no ring where the near-body box is the outermost one.
std::vector<Ring> plan_rings(const RingBoxes& boxes, const SizeField& size, double pieces_target);

/// Adds near-body box, rings and outermost box to the skeleton. Returns the edges of the outermost box, with the region
/// on their left; where something lies beyond it, they stand in the other direction as well.
std::vector<Segment> add_rings(Skeleton& skeleton, std::span<const Ring> rings, const RingBoxes& boxes,
                               const Separation& separation, bool something_beyond);

/// Adds the outline of a far field that is no box to the skeleton. Returns its edges, with the region on their left.
std::vector<Segment> add_outline(Skeleton& skeleton, const FarField& far_field, const Separation& separation);

}  // namespace lamina::decoupling
