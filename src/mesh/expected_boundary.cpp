#include "mesh/expected_boundary.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mesh/boundary_edges.hpp"
#include "mesh/check_markers.hpp"

namespace lamina::mesh {

namespace {

/// Returns whether a wall has one of these edges, which are sorted.
bool is_part_of_wall(std::span<const Marker> markers, std::span<const Segment> edges) {
    return std::any_of(markers.begin(), markers.end(), [&](const Marker& marker) {
        return may_be_wall(marker.kind) && std::any_of(marker.edges.begin(), marker.edges.end(), [&](Segment edge) {
                   return std::binary_search(edges.begin(), edges.end(), edge);
               });
    });
}

}  // namespace

ExpectedBoundary::ExpectedBoundary(std::span<const Point> points, std::span<const Marker> markers,
                                   std::vector<Segment> outer)
    : outer_(std::move(outer)) {
    std::vector<Segment> edges;
    for (const Marker& marker : markers)
        if (marker.kind != MarkerKind::internal) edges.insert(edges.end(), marker.edges.begin(), marker.edges.end());
    std::sort(edges.begin(), edges.end());
    std::vector<Segment> sorted_outer = outer_;
    std::sort(sorted_outer.begin(), sorted_outer.end());
    if (!std::includes(edges.begin(), edges.end(), sorted_outer.begin(), sorted_outer.end())) return;
    std::set_difference(edges.begin(), edges.end(), sorted_outer.begin(), sorted_outer.end(),
                        std::back_inserter(others_));
    DefectList defects;
    check_markers(points, markers, edges, defects);
    // Walls are measured once all is known of the cells behind them.
    if (!defects.empty() || !is_closed(edges) || is_part_of_wall(markers, sorted_outer)) return;
    summary_ = check_boundary(points, std::move(edges));
    flawless_ = summary_.defects.empty();
}

const BoundarySummary* ExpectedBoundary::summary_with(std::span<const Segment> others) const {
    return flawless_ && std::equal(others.begin(), others.end(), others_.begin(), others_.end()) ? &summary_ : nullptr;
}

}  // namespace lamina::mesh
