// Pieces of lines as other stages see them: sizes, obstacles of rays, edges of the layer, lines of the outer region and
// markers.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/lexicographic_order.hpp"
#include "core/segments.hpp"
#include "geometry/row.hpp"
#include "geometry/symmetry.hpp"
#include "pipeline/internal_lines.hpp"

namespace lamina::pipeline {

namespace {

/// Adds copies of lines that are so far along y.
void add_copies(std::span<const double> shifts, std::vector<std::vector<Point>>& lines) {
    const std::size_t n = lines.size();
    for (const double shift : shifts)
        for (std::size_t k = 0; k < n; ++k) lines.push_back(geometry::moved(lines[k], shift));
}

}  // namespace

std::vector<std::vector<Point>> ends_of_pieces(const LineGraph& graph) {
    std::vector<std::vector<Point>> ends;
    for (const Segment& piece : graph.pieces)
        ends.push_back({graph.points[piece.a.index()], graph.points[piece.b.index()]});
    return ends;
}

std::vector<SizeSource> sizes_between(const LineGraph& graph, std::span<const double> shifts) {
    // A line that crosses a sheet goes on behind a tiny gap. Of the piece, that is nothing, as for a vertex of its own.
    constexpr double across_sheet = 1e-6;
    std::vector<std::vector<Point>> pieces = ends_of_pieces(graph);
    add_copies(shifts, pieces);
    std::vector<Box> boxes;
    boxes.reserve(pieces.size());
    for (const std::vector<Point>& ends : pieces) boxes.push_back(core::bounding_box(ends));
    const core::BoxTree tree(std::move(boxes));
    std::vector<SizeSource> sources;
    for (const Point p : graph.points) {
        const double nearest = tree.min_distance(p, HUGE_VAL, [&](std::size_t k) {
            const Point a = pieces[k].front(), b = pieces[k].back();
            const double apart = core::distance_to_segment(p, a, b);
            return apart <= across_sheet * distance(a, b) ? HUGE_VAL : apart;
        });
        if (std::isfinite(nearest) && nearest > 0) sources.push_back({.a = p, .b = p, .size = nearest});
    }
    return sources;
}

std::vector<SizeSource> sizes_along(std::span<const InternalLine> lines) {
    std::vector<SizeSource> sources;
    for (const InternalLine& line : lines) {
        if (!line.size) continue;
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
            sources.push_back({.a = line.points[i], .b = line.points[i + 1], .size = *line.size});
    }
    return sources;
}

namespace {

/// Adds a line and its image in a line of symmetry as obstacles. It stops short of its ends, by a gap on a border. Rays
/// in the line of symmetry must not pass between both where the line ends there:
///
///        /       the line goes on beyond y by a gap,
///     --/------  y
///      \'        and its image ends two gaps below
///
void add_with_image(std::array<Point, 2> ends, std::array<Point, 2> gaps, double y, layers::Obstacles& obstacles) {
    const auto image = [&](Point p) { return geometry::image_of(p, y); };
    obstacles.outlines.push_back({ends[0] - gaps[0], ends[1] - gaps[1]});
    obstacles.outlines.push_back({image(ends[1] + 2 * gaps[1]), image(ends[0] + 2 * gaps[0])});
}

}  // namespace

namespace {

/// Returns the vertex at an end of a piece.
VertexId vertex_at_end(const Segment& piece, int end) { return end == 0 ? piece.a : piece.b; }

/// Returns the direction of a piece away from one of its ends.
Point direction_from(const LineGraph& graph, const Segment& piece, int end) {
    const Point along = unit(graph.points[piece.b.index()] - graph.points[piece.a.index()]);
    return end == 0 ? along : -along;
}

/// The beginning of a ray along a line.
using PlaceAndDirection = std::pair<Point, Point>;

struct PlacesFirst {
    bool operator()(const PlaceAndDirection& a, const PlaceAndDirection& b) const {
        return a.first == b.first ? lexicographically_less(a.second, b.second)
                                  : lexicographically_less(a.first, b.first);
    }
};

template <class T>
using AtFeet = std::map<PlaceAndDirection, T, PlacesFirst>;

}  // namespace

AtEnds room_at_feet(const LineGraph& graph) {
    constexpr double share = 0.45;  // both ends of a piece may be feet
    AtEnds room(graph.pieces.size());
    for (std::size_t i = 0; i < room.size(); ++i)
        for (const int end : {0, 1}) {
            const VertexId v = vertex_at_end(graph.pieces[i], end);
            if (!graph.on_wall[v.index()] && !graph.on_border[v.index()]) continue;
            room[i][end] =
                share * distance(graph.points[graph.pieces[i].a.index()], graph.points[graph.pieces[i].b.index()]);
        }
    return room;
}

AtEnds heights_at_feet(const LineGraph& graph, const layers::Rays& rays) {
    AtFeet<double> height_at;
    if (rays.enabled)
        for (std::size_t i = 0; i < rays.set.lines.size(); ++i)
            if (const layers::RayLine& ray = rays.set.lines[i]; ray.line_room > 0)
                height_at.emplace(PlaceAndDirection{ray.origin, ray.direction}, rays.front[i]);
    AtEnds heights(graph.pieces.size());
    std::vector<char> is_bare(graph.points.size());
    for (std::size_t i = 0; i < heights.size(); ++i)
        for (const int end : {0, 1}) {
            const std::size_t v = vertex_at_end(graph.pieces[i], end).index();
            const auto found = height_at.find({graph.points[v], direction_from(graph, graph.pieces[i], end)});
            if (found != height_at.end()) heights[i][end] = found->second;
            if (!(heights[i][end] > 0)) is_bare[v] = 1;
        }
    for (std::size_t i = 0; i < heights.size(); ++i)
        for (const int end : {0, 1})
            if (is_bare[vertex_at_end(graph.pieces[i], end).index()]) heights[i][end] = 0;
    return heights;
}

namespace {

/// Adds the foot of a line; with its image where there is a line of symmetry that cuts bodies.
void add_foot(const layers::LineFoot& foot, std::optional<double> symmetry, std::vector<layers::LineFoot>& feet) {
    feet.push_back(foot);
    if (!symmetry) return;
    feet.push_back({geometry::image_of(foot.at, *symmetry), {foot.direction.x, -foot.direction.y}, foot.room});
}

/// Adds a piece of a line, which stops short of vertices by this gap, or above these heights of the layer at its ends,
/// and the feet at these.
void add_piece(const LineGraph& graph, const Segment& piece, double gap, const std::array<double, 2>& at_feet,
               std::optional<double> symmetry, layers::Obstacles& obstacles) {
    constexpr double above_layer = 1.1;
    std::array<Point, 2> ends{graph.points[piece.a.index()], graph.points[piece.b.index()]}, on_line{};
    for (const int end : {0, 1}) {
        const VertexId v = vertex_at_end(piece, end);
        const Point away = direction_from(graph, piece, end);
        const double height = at_feet[end];
        const bool is_on_line = symmetry && graph.on_border[v.index()] && graph.points[v.index()].y == *symmetry;
        if (height > 0) add_foot({graph.points[v.index()], away, height}, symmetry, obstacles.feet);
        if (is_on_line && !(height > 0))
            on_line[end] = gap * away;
        else
            ends[end] = ends[end] + (height > 0 ? above_layer * height : gap) * away;
    }
    if (symmetry)
        add_with_image(ends, on_line, *symmetry, obstacles);
    else
        obstacles.outlines.push_back({ends[0], ends[1]});
}

}  // namespace

layers::Obstacles obstacles_of(const LineGraph& graph, double first_height, const AtEnds& at_feet,
                               std::optional<double> symmetry, std::span<const double> shifts) {
    constexpr double gap_share = 0.1;
    layers::Obstacles obstacles;
    for (std::size_t i = 0; i < graph.pieces.size(); ++i) {
        const Point a = graph.points[graph.pieces[i].a.index()], b = graph.points[graph.pieces[i].b.index()];
        add_piece(graph, graph.pieces[i], std::min(gap_share * first_height, 0.25 * distance(a, b)), at_feet[i],
                  symmetry, obstacles);
        for (const int end : {0, 1}) {
            const std::size_t v = vertex_at_end(graph.pieces[i], end).index();
            if ((graph.on_wall[v] || graph.on_border[v]) && !(at_feet[i][end] > 0))
                obstacles.bare.push_back(graph.points[v]);
        }
    }
    std::stable_sort(
        obstacles.feet.begin(), obstacles.feet.end(),
        [](const layers::LineFoot& a, const layers::LineFoot& b) { return lexicographically_less(a.at, b.at); });
    add_copies(shifts, obstacles.outlines);
    return obstacles;
}

std::vector<double> feet_on_border(const LineGraph& graph, double y) {
    std::vector<double> feet;
    for (std::size_t v = 0; v < graph.points.size(); ++v)
        if (graph.on_border[v] && graph.points[v].y == y) feet.push_back(graph.points[v].x);
    std::sort(feet.begin(), feet.end());
    return feet;
}

namespace {

/// A segment with the places of its ends.
struct PlacedSegment {
    Segment ends;
    Point a, b;
};

/// Returns whether two segments have more in common than one end.
bool meets_border(const PlacedSegment& line, const PlacedSegment& edge) {
    const bool shares_a = edge.ends.a == line.ends.a || edge.ends.b == line.ends.a;
    const bool shares_b = edge.ends.a == line.ends.b || edge.ends.b == line.ends.b;
    if (shares_a && shares_b) return true;
    const auto other_end = [&](VertexId v) { return edge.ends.a == v ? edge.b : edge.a; };
    if (shares_a) return core::segments_fold(line.a, line.b, other_end(line.ends.a));
    if (shares_b) return core::segments_fold(line.b, line.a, other_end(line.ends.b));
    return core::segments_meet(line.a, line.b, edge.a, edge.b);
}

}  // namespace

namespace {

/// Returns the vertices along a ray, from the wall to the front. Beside a ray of the same origin without layers the
/// border runs along the lowest piece, which it may divide.
std::vector<VertexId> vertices_along(const layers::Layer& layer, std::size_t element, std::size_t i) {
    const std::vector<layers::Ray>& rays = layer.rays[element];
    const std::vector<VertexId>& border = layer.borders[element];
    const layers::Ray& ray = rays[i];
    std::vector<VertexId> vertices;
    for (std::uint32_t n = 0; n <= ray.layers; ++n) vertices.push_back(ray.vertex(n));
    const std::optional<layers::BareSide> bare = layers::bare_side_of(rays, i);
    if (!bare) return vertices;
    const std::size_t length = border.size(), step = bare == layers::BareSide::after ? 1 : length - 1;
    auto at = static_cast<std::size_t>(std::find(border.begin(), border.end(), ray.tip()) - border.begin());
    for (std::size_t k = 0; k < length && border[at % length] != ray.origin; ++k) {
        if (k > 0) vertices.insert(vertices.begin() + 1, border[at % length]);
        at = at % length + step;
    }
    return vertices;
}

}  // namespace

FeetInLayer feet_in_layer(const LineGraph& graph, const layers::Layer& layer) {
    FeetInLayer feet(graph.pieces.size());
    AtFeet<std::vector<VertexId>*> at;
    for (std::size_t i = 0; i < feet.size(); ++i)
        for (const int end : {0, 1})
            if (const std::size_t v = vertex_at_end(graph.pieces[i], end).index();
                graph.on_wall[v] || graph.on_border[v])
                at.emplace(PlaceAndDirection{graph.points[v], direction_from(graph, graph.pieces[i], end)},
                           &feet[i][end]);
    if (at.empty()) return feet;
    for (std::size_t e = 0; e < layer.rays.size(); ++e)
        for (std::size_t i = 0; i < layer.rays[e].size(); ++i) {
            const layers::Ray& ray = layer.rays[e][i];
            if (!ray.along_line) continue;
            const auto found = at.find({layer.points[ray.origin.index()], ray.direction});
            if (found != at.end()) *found->second = vertices_along(layer, e, i);
        }
    return feet;
}

namespace {

/// The edges of the borders of a region.
struct BorderEdges {
    std::map<Point, VertexId, core::LexicographicOrder> vertex_at;
    std::vector<Segment> edges;
    std::vector<Box> boxes;
};

BorderEdges border_edges(const RegionBorders& region) {
    BorderEdges result;
    for (const std::vector<VertexId>& border : region.borders)
        for (std::size_t i = 0; i < border.size(); ++i) {
            const VertexId a = border[i], b = border[i + 1 < border.size() ? i + 1 : 0];
            result.vertex_at.emplace(region.points[a.index()], a);
            result.edges.push_back({a, b});
            result.boxes.push_back(core::bounding_box(region.points[a.index()], region.points[b.index()]));
        }
    return result;
}

}  // namespace

decoupling::InnerLines inner_lines(const LineGraph& graph, const FeetInLayer& feet, const RegionBorders& region) {
    decoupling::InnerLines inner;
    if (graph.pieces.empty()) return inner;
    BorderEdges border = border_edges(region);
    const auto place = [&](VertexId v) {
        return v.index() < region.points.size() ? region.points[v.index()]
                                                : inner.points[v.index() - region.points.size()];
    };
    std::map<Point, VertexId, core::LexicographicOrder>& vertex_at = border.vertex_at;
    const auto vertex = [&](std::size_t i, int end) {
        const std::vector<VertexId>& foot = feet[i][static_cast<std::size_t>(end)];
        const Point p = foot.size() > 1 ? region.points[foot.back().index()]
                                        : graph.points[vertex_at_end(graph.pieces[i], end).index()];
        const auto [found, is_new] = vertex_at.try_emplace(p, VertexId{region.points.size() + inner.points.size()});
        if (is_new) inner.points.push_back(p);
        return found->second;
    };
    const core::BoxTree tree(std::move(border.boxes));
    for (std::size_t i = 0; i < graph.pieces.size(); ++i) {
        const Segment line{vertex(i, 0), vertex(i, 1)};
        const Point a = place(line.a), b = place(line.b);
        tree.overlaps(core::bounding_box(a, b), [&](std::size_t e) {
            const Point c = region.points[border.edges[e].a.index()], d = region.points[border.edges[e].b.index()];
            if (meets_border({line, a, b}, {border.edges[e], c, d}))
                throw MeshError(
                    fmt::format("the layer crosses the line {} near ({}, {}): make it thinner there, or move the "
                                "line",
                                graph.given[graph.line[i]].name, c.x, c.y),
                    c);
        });
        inner.lines.push_back(line);
    }
    return inner;
}

void add_line_markers(const LineGraph& graph, const FeetInLayer& feet,
                      std::span<const std::vector<Segment>> inner_edges, std::vector<Marker>& markers) {
    const std::vector<InternalLine>& lines = graph.given;
    for (std::uint32_t k = 0; k < lines.size(); ++k) {
        if (std::any_of(markers.begin(), markers.end(), [&](const Marker& m) { return m.name == lines[k].name; }))
            throw OptionError("line", lines[k].name + ": another marker has this name already, so take another one");
        Marker marker{lines[k].name, MarkerKind::internal, {}};
        for (std::size_t i = 0; i < graph.pieces.size(); ++i) {
            if (graph.line[i] != k) continue;
            const auto& [first, last] = feet[i];
            for (std::size_t n = 1; n < first.size(); ++n) marker.edges.push_back({first[n - 1], first[n]});
            marker.edges.insert(marker.edges.end(), inner_edges[i].begin(), inner_edges[i].end());
            for (std::size_t n = last.size(); n-- > 1;) marker.edges.push_back({last[n], last[n - 1]});
        }
        if (!marker.edges.empty()) markers.push_back(std::move(marker));
    }
}

}  // namespace lamina::pipeline
