// The graph of a Voronoi diagram is the dual of the triangulation. Clipped cells are cut from the polygon by one
// bisector after another (I. E. Sutherland, G. W. Hodgman, Commun. ACM 17 (1974)).
#include <lamina/voronoi.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "delaunay/refine/triangle_shape.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

namespace {

constexpr std::size_t cells_per_block = 4096;

/// Cuts off the part of a convex polygon that is nearer to site + to_other than to the site. Corners are relative to
/// the site. `scratch` takes the old polygon.
void cut_by_bisector(std::vector<Point>& polygon, Point to_other, std::vector<Point>& scratch) {
    const double reach = 0.5 * squared_length(to_other);
    const auto excess = [&](Point p) { return dot(p, to_other) - reach; };
    if (std::none_of(polygon.begin(), polygon.end(), [&](Point p) { return excess(p) > 0; })) return;
    scratch.swap(polygon);
    polygon.clear();
    for (std::size_t k = 0; k < scratch.size(); ++k) {
        const Point p = scratch[k], q = scratch[k + 1 < scratch.size() ? k + 1 : 0];
        const double at_p = excess(p), at_q = excess(q);
        if (at_p <= 0) polygon.push_back(p);
        if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) polygon.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
    if (polygon.size() < 3) polygon.clear();
}

void check_polygon(std::span<const Point> polygon) {
    core::require_exact_range(polygon, "corner of the polygon");
    const std::size_t n = polygon.size();
    if (n < 3) throw InputError({}, core::concat("a polygon of ", n, " corners holds no cells"));
    for (std::size_t i = 0; i < n; ++i) {
        const Point a = polygon[i], b = polygon[(i + 1) % n];
        for (std::size_t k = 2; k < n; ++k)
            if (const Point c = polygon[(i + k) % n]; orient2d(a, b, c) < 0 || (k == 2 && orient2d(a, b, c) == 0))
                throw InputError({.at = b}, "the polygon is not strictly convex and counter-clockwise");
    }
}

/// Returns the neighbours of points that lie on one line, which are those before and after along it.
IndexLists neighbours_on_line(std::span<const Point> points) {
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return lexicographically_less(points[a], points[b]); });
    std::vector<std::array<Index, 2>> pairs(points.size(), {no_index, no_index});
    for (std::size_t i = 1; i < order.size(); ++i) {
        pairs[order[i]][0] = order[i - 1];
        pairs[order[i - 1]][1] = order[i];
    }
    IndexLists lists;
    for (const auto& pair : pairs) {
        for (const Index v : pair)
            if (v != no_index) lists.items.push_back(v);
        lists.starts.push_back(static_cast<Index>(lists.items.size()));
    }
    return lists;
}

/// Returns the vertices that share an edge with each point.
IndexLists neighbours_in_triangles(std::size_t points, std::span<const Triangle> triangles) {
    const std::vector<std::uint32_t> twins = half_edges(points, triangles);
    const IndexLists at = half_edges_at_points(points, triangles, twins);
    IndexLists lists;
    for (std::size_t v = 0; v < points; ++v) {
        for (const std::uint32_t h : at[v]) {
            lists.items.push_back(origin(triangles, next_half_edge(h)).value);
            const std::uint32_t last = previous_half_edge(h);
            if (twins[last] == no_half_edge) lists.items.push_back(origin(triangles, last).value);
        }
        lists.starts.push_back(static_cast<Index>(lists.items.size()));
    }
    return lists;
}

/// Appends the cells of a range of points.
VoronoiCells clip_cells(std::span<const Point> points, const IndexLists& neighbours, std::span<const Point> polygon,
                        std::size_t begin, std::size_t end) {
    VoronoiCells cells;
    std::vector<Point> cell, scratch;
    const bool lonely = points.size() == 1;
    for (std::size_t v = begin; v < end; ++v) {
        cell.clear();
        if (!neighbours[v].empty() || lonely)
            for (const Point corner : polygon) cell.push_back(corner - points[v]);
        for (const Index w : neighbours[v]) {
            if (cell.empty()) break;
            cut_by_bisector(cell, points[w] - points[v], scratch);
        }
        for (const Point corner : cell) cells.corners.push_back(points[v] + corner);
        cells.starts.push_back(static_cast<Index>(cells.corners.size()));
    }
    return cells;
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

VoronoiDiagram voronoi_diagram(std::span<const Point> points, std::span<const Triangle> triangles) {
    check_points(points);
    const std::vector<std::uint32_t> twins = half_edges(points.size(), triangles);
    VoronoiDiagram diagram;
    diagram.corners.resize(triangles.size());
    core::parallel_for(triangles.size(), cells_per_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const auto& v = triangles[t].v;
            diagram.corners[t] = circumcentre(points[v[0].index()], points[v[1].index()], points[v[2].index()]);
        }
    });
    diagram.cells = half_edges_at_points(points.size(), triangles, twins);
    for (Index& corner : diagram.cells.items) corner /= 3;
    for (const std::uint32_t h : boundary_loops(twins).items) {
        const VertexId a = origin(triangles, h), b = origin(triangles, next_half_edge(h));
        diagram.rays.push_back({a, b, TriangleId{h / 3}, -perpendicular(points[b.index()] - points[a.index()])});
    }
    return diagram;
}

VoronoiCells clipped_voronoi_cells(std::span<const Point> points, std::span<const Triangle> triangles,
                                   std::span<const Point> polygon) {
    check_points(points);
    check_polygon(polygon);
    const IndexLists neighbours =
        triangles.empty() ? neighbours_on_line(points) : neighbours_in_triangles(points.size(), triangles);
    const auto blocks = core::parallel_blocks(points.size(), cells_per_block, [&](std::size_t begin, std::size_t end) {
        return clip_cells(points, neighbours, polygon, begin, end);
    });
    VoronoiCells cells;
    for (const VoronoiCells& block : blocks) {
        const auto offset = static_cast<Index>(cells.corners.size());
        for (std::size_t i = 1; i < block.starts.size(); ++i) cells.starts.push_back(offset + block.starts[i]);
        cells.corners.insert(cells.corners.end(), block.corners.begin(), block.corners.end());
    }
    return cells;
}

}  // namespace lamina
