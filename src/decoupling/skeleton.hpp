// The lines between subdomains while they are being drawn.
#pragma once

#include <span>
#include <vector>

#include <lamina/decoupling.hpp>

#include "decoupling/separators.hpp"

namespace lamina::decoupling {

/// Points and directed edges of all borders. An edge has the region to be meshed on its left; an edge between two
/// subdomains stands in both directions.
struct Skeleton {
    std::vector<Point> points;
    std::vector<Segment> edges;

    VertexId add_point(Point p) {
        points.push_back(p);
        return VertexId{points.size() - 1};
    }
    /// Adds edges along a chain of vertices, in its direction and, where there are subdomains on both sides, in the
    /// other direction as well.
    void add_chain(std::span<const VertexId> chain, bool both_directions);
};

/// Returns the edges along a chain of vertices.
std::vector<Segment> chain_edges(std::span<const VertexId> chain);

/// Adds the outline of a far field that is no box. Returns its edges, with the region on their left.
std::vector<Segment> add_far_field_outline(Skeleton& skeleton, const FarField& far_field,
                                           const SeparatorSpacing& spacing);

}  // namespace lamina::decoupling
