#include "pipeline/close_sheets.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/lexicographic_order.hpp"
#include "core/segments.hpp"
#include "geometry/sheets.hpp"
#include "pipeline/divide_boundary.hpp"

namespace lamina::pipeline {

namespace {

using PointSet = std::set<Point, core::LexicographicOrder>;

/// Vertices nearer to each other than so many gaps are the same one on both sides.
constexpr double reach_in_gaps = 16;

/// The vertices of a sheet, sorted by x.
class SheetVertices {
public:
    SheetVertices(const std::vector<Point>& points, const Marker& marker, double reach)
        : points_(points), reach_(reach) {
        for (const Segment& edge : marker.edges)
            for (const VertexId v : {edge.a, edge.b}) sorted_.push_back(v);
        std::sort(sorted_.begin(), sorted_.end(), [&](VertexId a, VertexId b) {
            return at(a) == at(b) ? a < b : lexicographically_less(at(a), at(b));
        });
        sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
    }

    std::span<const VertexId> all() const { return sorted_; }
    Point at(VertexId v) const { return points_[v.index()]; }
    /// Returns the other vertices at the place of a vertex.
    std::vector<VertexId> near(VertexId v) const {
        std::vector<VertexId> found;
        const auto first = std::lower_bound(sorted_.begin(), sorted_.end(), at(v).x - reach_,
                                            [&](VertexId a, double x) { return at(a).x < x; });
        for (auto other = first; other != sorted_.end() && at(*other).x <= at(v).x + reach_; ++other)
            if (*other != v && distance(at(*other), at(v)) < reach_) found.push_back(*other);
        return found;
    }

private:
    const std::vector<Point>& points_;
    double reach_;
    std::vector<VertexId> sorted_;
};

bool is_tip(const SheetSides& sheet, Point p) {
    return p == sheet.tip || (p == sheet.begin && sheet.begin == sheet.end);
}

/// Returns the edges of a sheet that are to be divided, so that both sides have the same vertices: those beside which a
/// vertex of the other side has no partner.
std::vector<DividedEdge> edges_to_divide(const SheetVertices& vertices, const Marker& marker, const SheetSides& sheet,
                                         double reach) {
    std::vector<Box> boxes;
    for (const Segment& edge : marker.edges) {
        Box box = core::bounding_box(vertices.at(edge.a), vertices.at(edge.b));
        box.include(box.lower - Point{reach, reach});
        box.include(box.upper + Point{reach, reach});
        boxes.push_back(box);
    }
    const core::BoxTree tree(std::move(boxes));
    std::map<std::size_t, std::vector<Point>> divided;
    for (const VertexId v : vertices.all()) {
        const Point p = vertices.at(v);
        if (is_tip(sheet, p) || !vertices.near(v).empty()) continue;
        tree.overlaps({p, p}, [&](std::size_t e) {
            const Segment edge = marker.edges[e];
            if (edge.a != v && edge.b != v &&
                core::distance_to_segment(p, vertices.at(edge.a), vertices.at(edge.b)) < reach)
                divided[e].push_back(p);
        });
    }
    std::vector<DividedEdge> edges;
    for (auto& [e, at] : divided) {
        const Point from = vertices.at(marker.edges[e].a);
        std::sort(at.begin(), at.end(), [&](Point a, Point b) { return distance(from, a) < distance(from, b); });
        edges.push_back({marker.edges[e], std::move(at)});
    }
    return edges;
}

/// A vertex of a sheet and the place that it is moved to.
struct MovedVertex {
    VertexId vertex;
    Point to;
};

/// Returns the moves that close a sheet; nothing where a vertex but a tip has none or several on the other side.
/// `first_side` holds the points that are to stay.
std::optional<std::vector<MovedVertex>> closing_moves(const SheetVertices& vertices, const SheetSides& sheet,
                                                      const PointSet& first_side) {
    std::vector<MovedVertex> moves;
    for (const VertexId v : vertices.all()) {
        const Point p = vertices.at(v);
        const std::vector<VertexId> near = vertices.near(v);
        if (near.size() != (is_tip(sheet, p) ? 0 : 1)) return std::nullopt;
        if (near.empty()) continue;
        // Of two vertices that no point of the outline stands for, as on edges that were divided, the first one stays.
        const Point other = vertices.at(near[0]);
        const bool stays = first_side.contains(p) || (!first_side.contains(other) && v < near[0]);
        if (!stays) moves.push_back({v, other});
    }
    return moves;
}

/// Closes a sheet. Returns whether it could.
bool close_sheet(const Element& element, const SheetSides& sheet, const geometry::SheetRange& range,
                 MeshResult& result) {
    std::vector<Point> curve;
    for (std::size_t i = range.first; i <= range.tip; ++i) curve.push_back(element.points[i % element.points.size()]);
    const double reach = reach_in_gaps * geometry::sheet_gap(curve);
    const std::vector<Marker>& markers = result.mesh.markers;
    const auto marker =
        std::find_if(markers.begin(), markers.end(), [&](const Marker& m) { return m.name == sheet.name; });
    if (marker == markers.end()) return false;
    divide_boundary(edges_to_divide(SheetVertices(result.mesh.points, *marker, reach), *marker, sheet, reach), result);
    const auto moves =
        closing_moves(SheetVertices(result.mesh.points, *marker, reach), sheet, {curve.begin(), curve.end()});
    if (!moves) return false;
    for (const MovedVertex& move : *moves) result.mesh.points[move.vertex.index()] = move.to;
    return true;
}

}  // namespace

bool has_sheets(const Geometry& geometry) {
    return std::any_of(geometry.elements.begin(), geometry.elements.end(),
                       [](const Element& element) { return !element.sheets.empty(); });
}

void close_sheets(MeshResult& result) {
    for (std::size_t e = 0; e < result.geometry.elements.size(); ++e) {
        const Element element = result.geometry.elements[e];
        const std::vector<geometry::SheetRange> ranges = geometry::sheet_ranges(element);
        const auto is_shown = [&](const SheetSides& sheet) {
            return !element.is_mirrored || sheet.tip.y > *result.geometry.symmetry;
        };
        for (std::size_t k = 0; k < ranges.size(); ++k)
            if (is_shown(element.sheets[k]) && !close_sheet(element, element.sheets[k], ranges[k], result))
                result.geometry.elements[e].surface_notes.push_back(
                    fmt::format("the sides of {} have different vertices, and stay {:.2g} apart",
                                element.sheets[k].name, geometry::sheet_gap(element.points)));
    }
}

}  // namespace lamina::pipeline
