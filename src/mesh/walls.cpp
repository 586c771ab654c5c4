#include "mesh/walls.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"

namespace lamina::mesh {

namespace {

/// A directed edge of a wall, the mesh on its left.
struct WallEdge {
    VertexId from, to;
    const BoundaryEdge* edge;
    std::size_t marker;  ///< in Mesh::markers
};

/// Returns the edges of all walls, sorted by their first vertex.
std::vector<WallEdge> wall_edges(std::span<const Marker> markers, std::span<const BoundaryEdge> boundary) {
    std::vector<std::pair<Segment, std::size_t>> segments;  // and their markers
    for (std::size_t m = 0; m < markers.size(); ++m)
        if (may_be_wall(markers[m].kind))
            for (const Segment& segment : markers[m].edges) segments.emplace_back(segment, m);
    std::sort(segments.begin(), segments.end());
    std::vector<WallEdge> walls;
    for (const BoundaryEdge& edge : boundary) {
        const Segment segment = edge.ends;
        const auto found = std::lower_bound(segments.begin(), segments.end(), std::pair{segment, std::size_t{0}});
        if (found != segments.end() && found->first == segment)
            walls.push_back({segment.a, segment.b, &edge, found->second});
    }
    std::sort(walls.begin(), walls.end(), [](const WallEdge& a, const WallEdge& b) { return a.from < b.from; });
    return walls;
}

/// Returns whether two edges meet at a corner of a base: a convex one nearer to a right angle than to a straight wall
/// or a sharp edge. The mesh lies on the left of both, so that the wall turns right round a convex corner.
bool is_corner_of_base(Point a, Point b, Point c) {
    constexpr double min_turning_deg = 45, max_turning_deg = 135;
    const double turning = -core::degrees(core::angle_between(b - a, c - b));
    return turning > min_turning_deg && turning < max_turning_deg;
}

/// Compares the lengths of neighbouring edges. Vertices that several walls pass are left out.
void measure_ratios(std::span<const Point> points, std::span<const WallEdge> walls, WallSummary& summary) {
    const auto begins_before = [](const WallEdge& edge, VertexId v) { return edge.from < v; };
    for (const WallEdge& wall : walls) {
        const auto after = std::lower_bound(walls.begin(), walls.end(), wall.to, begins_before);
        if (after == walls.end() || after->from != wall.to) continue;
        if (after + 1 != walls.end() && (after + 1)->from == wall.to) continue;
        const Point a = points[wall.from.index()], b = points[wall.to.index()], c = points[after->to.index()];
        if (a == b || b == c || is_corner_of_base(a, b, c)) continue;
        const double before_length = distance(a, b), after_length = distance(b, c);
        const double ratio = std::max(before_length, after_length) / std::min(before_length, after_length);
        summary.uneven_vertices += ratio > even_wall_ratio;
        if (!(ratio > summary.max_ratio)) continue;
        summary.max_ratio = ratio;
        summary.max_ratio_at = b;
    }
}

/// The height of a cell of the first layer.
struct FirstHeight {
    double height;
    VertexId at, to;  ///< the ends of its edge
};

/// Returns the heights of the cells of the first layer, marker by marker.
std::vector<std::vector<FirstHeight>> first_heights_of_markers(std::span<const Point> points, std::size_t markers,
                                                               std::span<const WallEdge> walls) {
    std::vector<std::vector<FirstHeight>> heights(markers);
    for (const WallEdge& wall : walls)
        if (wall.edge->in_first_layer && points[wall.from.index()] != points[wall.to.index()])
            heights[wall.marker].push_back({wall.edge->height, wall.from, wall.to});
    return heights;
}

/// Returns the median height. Precondition: there is one.
double median_height(std::vector<FirstHeight> heights) {
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end(),
                     [](const FirstHeight& a, const FirstHeight& b) { return a.height < b.height; });
    return middle->height;
}

/// Counts the edges without a cell of the layer.
void count_bare_edges(std::span<const Point> points, std::span<const Marker> markers, std::span<const WallEdge> walls,
                      WallSummary& summary) {
    const auto is_bare = [](const WallEdge& wall) {
        return !wall.edge->in_first_layer && !wall.edge->beyond_first_layer;
    };
    if (std::all_of(walls.begin(), walls.end(), is_bare)) return;
    std::vector<char> has_layer(markers.size());
    for (std::size_t m = 0; m < markers.size(); ++m) has_layer[m] = markers[m].kind == MarkerKind::wall;
    for (const WallEdge& wall : walls)
        if (!is_bare(wall)) has_layer[wall.marker] = 1;
    for (const WallEdge& wall : walls) {
        if (!is_bare(wall) || !has_layer[wall.marker]) continue;
        if (summary.bare_edges++ == 0) summary.bare_at = points[wall.from.index()];
    }
}

/// Returns a height over the one wanted on its edge.
double over_wanted(const FirstHeight& first, double on_marker, std::span<const double> at_vertices) {
    if (std::max(first.at.index(), first.to.index()) >= at_vertices.size()) return first.height / on_marker;
    const auto [low, high] = std::minmax({at_vertices[first.at.index()], at_vertices[first.to.index()]});
    return first.height / std::clamp(first.height, low, high);
}

void measure_first_heights(std::span<const Point> points, std::span<const Marker> markers,
                           std::span<const WallEdge> walls, const MeshCheckOptions& options, WallSummary& summary) {
    const std::vector<std::vector<FirstHeight>> by_marker = first_heights_of_markers(points, markers.size(), walls);
    std::vector<FirstHeight> all;
    std::size_t all_kept = 0;
    double worst = 0;
    for (std::size_t m = 0; m < by_marker.size(); ++m) {
        const std::vector<FirstHeight>& heights = by_marker[m];
        if (heights.empty()) continue;
        const double median = median_height(heights);
        const double wanted =
            options.first_heights.empty() ? options.first_height.value_or(median) : options.first_heights[m];
        std::size_t kept = 0;
        for (const FirstHeight& first : heights) {
            const double share = over_wanted(first, wanted, options.first_height_at), deviation = std::abs(share - 1);
            kept += deviation <= first_height_tolerance;
            if (!(deviation > worst)) continue;
            worst = deviation;
            summary.worst_first_height = share;
            summary.worst_first_height_at = points[first.at.index()];
        }
        summary.first_heights.push_back(
            {markers[m].name, heights.size(), median, static_cast<double>(kept) / static_cast<double>(heights.size())});
        all_kept += kept;
        all.insert(all.end(), heights.begin(), heights.end());
    }
    if (all.empty()) return;
    summary.first_cells = all.size();
    summary.share_of_kept_heights = static_cast<double>(all_kept) / static_cast<double>(all.size());
    summary.median_first_height = median_height(std::move(all));
}

}  // namespace

std::vector<Segment> sorted_wall_edges(std::span<const Marker> markers) {
    std::vector<Segment> edges;
    for (const Marker& marker : markers)
        if (may_be_wall(marker.kind)) edges.insert(edges.end(), marker.edges.begin(), marker.edges.end());
    std::sort(edges.begin(), edges.end());
    return edges;
}

WallSummary measure_walls(std::span<const Point> points, std::span<const Marker> markers,
                          std::span<const BoundaryEdge> boundary, const MeshCheckOptions& options) {
    const std::vector<WallEdge> walls = wall_edges(markers, boundary);
    WallSummary summary;
    summary.edges = walls.size();
    measure_ratios(points, walls, summary);
    count_bare_edges(points, markers, walls, summary);
    measure_first_heights(points, markers, walls, options, summary);
    return summary;
}

}  // namespace lamina::mesh
