// The outlines become segments of one constrained triangulation, in which crossings are vertices. The triangles that
// any body winds round are the union, and the outer loops of its border are the outlines.
#include "geometry/unite.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/delaunay_connectivity.hpp>
#include <lamina/predicates.hpp>
#include <lamina/triangulation.hpp>

#include "core/bounding_box.hpp"
#include "core/polygon.hpp"
#include "core/text.hpp"
#include "geometry/inside.hpp"

namespace lamina::geometry {

namespace {

/// The bodies in one triangulation. Each point and each segment stands for one point of an outline, one body after the
/// other; points that are equal to earlier ones stand for these.
struct Arrangement {
    std::vector<Point> points;               ///< of the outlines, then the crossings
    std::vector<std::uint32_t> body, index;  ///< per point of an outline
    ConstrainedTriangulation cells;
};

Arrangement arrange(const Geometry& geometry) {
    Arrangement result;
    std::vector<Segment> segments;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const std::vector<Point>& outline = geometry.elements[e].points;
        const std::size_t first = result.points.size(), n = outline.size();
        for (std::size_t i = 0; i < n; ++i) {
            if (!in_exact_range(outline[i]))
                throw InputError({geometry.elements[e].file, 0, outline[i]}, "coordinates outside the exact range");
            result.points.push_back(outline[i]);
            result.body.push_back(static_cast<std::uint32_t>(e));
            result.index.push_back(static_cast<std::uint32_t>(i));
            segments.push_back({VertexId(first + i), VertexId(first + (i + 1) % n)});
        }
    }
    result.cells = triangulate(result.points, segments,
                               {.keep = KeptRegion::non_zero, .crossings = Crossings::insert, .merge_distance = 0.0});
    result.points.insert(result.points.end(), result.cells.steiner_points.begin(), result.cells.steiner_points.end());
    return result;
}

/// A vertex of an outline of the union, and the body that the edge behind it comes from.
struct OutlineVertex {
    std::size_t vertex;
    std::size_t body;
};

using OutlineLoop = std::vector<OutlineVertex>;

/// Returns the loops of the border of the union.
std::vector<OutlineLoop> border_loops(const Arrangement& arrangement) {
    const std::vector<Triangle>& triangles = arrangement.cells.triangles;
    std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> bodies;  // of edges
    for (std::size_t i = 0; i < arrangement.cells.segments.size(); ++i) {
        const Segment s = arrangement.cells.segments[i];
        bodies.push_back({std::minmax(s.a.value, s.b.value), arrangement.body[arrangement.cells.parents[i]]});
    }
    std::sort(bodies.begin(), bodies.end());
    const std::vector<std::uint32_t> twins = half_edges(arrangement.points.size(), triangles);
    const IndexLists lists = boundary_loops(twins);
    std::vector<OutlineLoop> loops;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        OutlineLoop& loop = loops.emplace_back();
        for (const std::uint32_t h : lists[i]) {
            const VertexId a = origin(triangles, h), b = origin(triangles, next_half_edge(h));
            const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(a.value, b.value);
            const auto found = std::lower_bound(bodies.begin(), bodies.end(), std::pair{edge, std::uint32_t{0}});
            loop.push_back({a.index(), found->second});
        }
    }
    return loops;
}

/// Throws InputError where outlines pass a vertex twice.
void require_no_touching_points(const Geometry& geometry, const Arrangement& arrangement,
                                const std::vector<OutlineLoop>& outlines) {
    std::vector<char> passed(arrangement.points.size());
    for (const OutlineLoop& loop : outlines)
        for (const OutlineVertex& v : loop)
            if (std::exchange(passed[v.vertex], 1) != 0) {
                const Element& element = geometry.elements[v.body];
                const Point at = arrangement.points[v.vertex];
                throw InputError({element.file, 0, at},
                                 fmt::format("element {} touches itself or another one at the single point ({}, {}): "
                                             "move it, so that they overlap or stand apart",
                                             element.name, at.x, at.y));
            }
}

/// The outer outlines of the union, and the pockets that they enclose.
struct UnionOutlines {
    std::vector<OutlineLoop> outlines;
    std::size_t pockets = 0;
};

/// Sorts loops: outlines that lie in pockets of others are left out with these.
UnionOutlines outer_outlines(const Arrangement& arrangement, std::vector<OutlineLoop> loops) {
    UnionOutlines result;
    std::vector<std::vector<Point>> polygons;
    std::vector<Box> boxes;
    std::vector<OutlineLoop> candidates;
    for (OutlineLoop& loop : loops) {
        const auto vertex = [&](std::size_t i) { return arrangement.points[loop[i].vertex]; };
        if (core::polygon_orientation(loop.size(), vertex) < 0) {
            ++result.pockets;
            continue;
        }
        std::vector<Point>& polygon = polygons.emplace_back();
        for (std::size_t i = 0; i < loop.size(); ++i) polygon.push_back(vertex(i));
        boxes.push_back(core::bounding_box(polygon));
        candidates.push_back(std::move(loop));
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        bool is_inside = false;
        for (std::size_t j = 0; j < candidates.size() && !is_inside; ++j) {
            // A vertex that both have is no proof, and require_no_touching_points() refuses it.
            const Point p = polygons[i].front();
            is_inside = j != i && boxes[j].contains(p) && contains(polygons[j], p) &&
                        std::find(polygons[j].begin(), polygons[j].end(), p) == polygons[j].end();
        }
        if (!is_inside) result.outlines.push_back(std::move(candidates[i]));
    }
    return result;
}

/// Returns whether a loop is an outline as it was given.
bool is_unchanged(const Arrangement& arrangement, const Geometry& geometry, const OutlineLoop& loop) {
    const std::size_t body = loop.front().body;
    const std::vector<Point>& given = geometry.elements[body].points;
    if (loop.size() != given.size()) return false;
    for (std::size_t i = 0; i < loop.size(); ++i)
        if (loop[i].body != body || arrangement.points[loop[i].vertex] != given[i]) return false;
    return true;
}

/// Rotates a loop so that it begins at the first of its points that was given.
void begin_at_given_point(OutlineLoop& loop) {
    const auto first = std::min_element(
        loop.begin(), loop.end(), [](const OutlineVertex& a, const OutlineVertex& b) { return a.vertex < b.vertex; });
    std::rotate(loop.begin(), first, loop.end());
}

/// Returns the element of an outline that several bodies share, or one that crossed itself.
Element joined(const Arrangement& arrangement, const Geometry& geometry, const OutlineLoop& loop) {
    std::vector<std::size_t> bodies;
    for (const OutlineVertex& v : loop) bodies.push_back(v.body);
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    Element element = geometry.elements[bodies.front()];
    element.points.clear();
    element.lines.clear();
    element.given_corners.clear();
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const OutlineVertex &v = loop[i], &before = loop[(i + loop.size() - 1) % loop.size()];
        const bool is_crossing = v.vertex >= arrangement.body.size(), changes = v.body != before.body;
        bool is_corner = is_crossing || changes;
        std::size_t line = 0;
        if (!is_crossing) {
            const Element& body = geometry.elements[arrangement.body[v.vertex]];
            const std::size_t index = arrangement.index[v.vertex];
            is_corner = is_corner || std::binary_search(body.given_corners.begin(), body.given_corners.end(), index);
            if (body.file == element.file && index < body.lines.size()) line = body.lines[index];
        }
        if (changes) element.parts.push_back({geometry.elements[v.body].name, arrangement.points[v.vertex]});
        if (is_corner) element.given_corners.push_back(i);
        crossings += is_crossing ? 1 : 0;
        element.points.push_back(arrangement.points[v.vertex]);
        element.lines.push_back(line);
    }
    for (const std::size_t body : bodies) {
        const Element& other = geometry.elements[body];
        element.samples_of_curve = element.samples_of_curve || other.samples_of_curve;
        if (body == bodies.front()) continue;
        element.points_read += other.points_read;
        for (const std::string& repair : other.repairs)
            element.repairs.push_back(other.file == element.file ? repair : core::concat(other.file, ": ", repair));
        element.warnings.insert(element.warnings.end(), other.warnings.begin(), other.warnings.end());
        element.transformations.push_back(fmt::format("joined with {}", other.name));
    }
    element.transformations.push_back(fmt::format("outline of the union with {} crossings", crossings));
    return element;
}

}  // namespace

Geometry unite(Geometry geometry) {
    const Arrangement arrangement = arrange(geometry);
    const UnionOutlines found = outer_outlines(arrangement, border_loops(arrangement));
    require_no_touching_points(geometry, arrangement, found.outlines);
    std::vector<std::pair<std::size_t, Element>> elements;  // with the first body of each
    std::vector<char> is_shown(geometry.elements.size());
    for (OutlineLoop loop : found.outlines) {
        begin_at_given_point(loop);
        std::size_t first = loop.front().body;
        for (const OutlineVertex& v : loop) {
            first = std::min(first, v.body);
            is_shown[v.body] = 1;
        }
        elements.emplace_back(first, is_unchanged(arrangement, geometry, loop) ? geometry.elements[first]
                                                                               : joined(arrangement, geometry, loop));
    }
    std::stable_sort(elements.begin(), elements.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Geometry result = geometry;
    result.elements.clear();
    for (auto& [first, element] : elements) result.elements.push_back(std::move(element));
    std::vector<std::string>& notes = result.elements.front().transformations;
    if (found.pockets > 0) notes.push_back(core::counted(found.pockets, "pocket") + " that the union encloses filled");
    for (std::size_t e = 0; e < is_shown.size(); ++e)
        if (is_shown[e] == 0) notes.push_back(fmt::format("{} lies inside the union", geometry.elements[e].name));
    return result;
}

std::vector<std::size_t> parts_of_edges(const Element& element) {
    const std::size_t n = element.points.size();
    std::vector<std::size_t> parts(n);
    if (element.parts.empty()) return parts;
    const auto begun_at = [&](std::size_t i) {
        return std::find_if(element.parts.begin(), element.parts.end(),
                            [&](const WallPart& part) { return part.begin == element.points[i]; });
    };
    std::size_t first = 0;
    while (first < n && begun_at(first) == element.parts.end()) ++first;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = (first + k) % n;
        const auto found = begun_at(i);
        parts[i] = found != element.parts.end() ? static_cast<std::size_t>(found - element.parts.begin())
                                                : parts[(i + n - 1) % n];
    }
    return parts;
}

}  // namespace lamina::geometry
