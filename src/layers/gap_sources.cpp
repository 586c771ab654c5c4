// The search for gaps between edges, and the sources along an edge that faces one.
#include "layers/gap_sources.hpp"

#include <algorithm>
#include <cmath>

#include "core/segments.hpp"

namespace lamina::layers {

namespace {

/// Two edges that see each other form a gap, rather than a corner, if the cosine of the angle between their directions
/// is below this.
constexpr double max_facing_cosine = -0.3;
/// Gaps narrower than this share of an edge do not divide it further.
constexpr double min_gap_share = 1.0 / 128;

/// Returns the distance of two segments that do not cross.
double segment_distance(Point a, Point b, const PolygonEdge& other) {
    return std::min({core::distance_to_segment(a, other.a, other.b), core::distance_to_segment(b, other.a, other.b),
                     core::distance_to_segment(other.a, a, b), core::distance_to_segment(other.b, a, b)});
}

/// Returns the edges that lie across a gap from this one, no farther away than about its length.
std::vector<const PolygonEdge*> edges_across(std::span<const PolygonEdge> edges, const core::BoxTree& tree,
                                             std::size_t i) {
    std::vector<const PolygonEdge*> across;
    const PolygonEdge& edge = edges[i];
    Box near = core::bounding_box(edge.a, edge.b);
    near.lower = near.lower - Point{edge.length, edge.length};
    near.upper = near.upper + Point{edge.length, edge.length};
    tree.overlaps(near, [&](std::size_t j) {
        const PolygonEdge& other = edges[j];
        if (j == i || j == edge.previous || j == edge.next) return;
        const Point u = edge.b - edge.a, v = other.b - other.a;
        if (dot(u, v) > max_facing_cosine * edge.length * other.length) return;
        // Each must lie on the right of the other, where the outside is.
        const Point between = midpoint(other.a, other.b) - midpoint(edge.a, edge.b);
        if (cross(u, between) < 0 && cross(v, between) > 0) across.push_back(&other);
    });
    return across;
}

/// Adds the sources of the part a-b of an edge.
void add_part_sources(Point a, Point b, double requested_length, std::span<const PolygonEdge* const> across,
                      std::vector<SizeSource>& sources) {
    const double length = distance(a, b);
    double gap = HUGE_VAL;
    for (const PolygonEdge* other : across) gap = std::min(gap, segment_distance(a, b, *other));
    if (gap < requested_length && gap < length && length > min_gap_share * requested_length) {
        const Point middle = midpoint(a, b);
        add_part_sources(a, middle, requested_length, across, sources);
        add_part_sources(middle, b, requested_length, across, sources);
        return;
    }
    sources.push_back({a, b, std::clamp(gap, min_gap_share * requested_length, requested_length)});
}

}  // namespace

void add_edge_sources(std::span<const PolygonEdge> edges, const core::BoxTree& tree, std::size_t edge,
                      double requested_length, std::vector<SizeSource>& sources) {
    add_part_sources(edges[edge].a, edges[edge].b, requested_length, edges_across(edges, tree, edge), sources);
}

}  // namespace lamina::layers
