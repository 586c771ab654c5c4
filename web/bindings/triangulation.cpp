// The triangulation alone, as a module of its own: dist/triangulation.wasm, which web/src/triangulation.ts wraps. Its
// two functions take and return addresses in the memory of the module, so it needs nothing of Embind.
//
// Triangles are delaunator's: clockwise where y points upwards, so counter-clockwise on a screen.
//
//          c                half-edge 3 t runs from a to c, 3 t + 1 from c to b, 3 t + 2 from b to a;
//         /  \.             the triangle is on the right of each
//        a -- b
#include <algorithm>
#include <cstdint>
#include <exception>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <lamina/delaunay_connectivity.hpp>
#include <lamina/triangulation.hpp>

namespace {

using namespace lamina;
using Indices = std::vector<std::uint32_t>;

/// What is returned. All numbers are indices of the points that were given.
struct Arrays {
    std::vector<Triangle> triangles;
    Indices halfedges;                      ///< the opposite half-edge of each, no_half_edge (-1) on the hull
    std::vector<std::uint8_t> constrained;  ///< per half-edge: 1 on a segment, else 0
    Indices hull;                           ///< in the direction of its half-edges; points on one line: from end to end
    std::string error;                      ///< what is wrong with the input; empty: nothing
};

/// Where each array begins in the memory of the module, and how many numbers it has: what JavaScript reads.
struct View {
    Arrays arrays;
    std::uint32_t triangles, corners, halfedges, constrained, hull, hull_size, error, error_size;
};

/// The points without those that equal an earlier one.
struct DistinctPoints {
    std::vector<Point> points;
    Indices original;  ///< per distinct point: its number among the given points
    Indices distinct;  ///< per given point: the distinct one that stands for it
};

DistinctPoints distinct_points(std::span<const Point> given) {
    DistinctPoints result;
    const Indices first = merge_points(given, 0);
    result.distinct.resize(given.size());
    for (std::uint32_t i = 0; i < given.size(); ++i) {
        if (first[i] == i) {
            result.distinct[i] = static_cast<std::uint32_t>(result.points.size());
            result.points.push_back(given[i]);
            result.original.push_back(i);
        } else {
            result.distinct[i] = result.distinct[first[i]];
        }
    }
    return result;
}

/// Returns the numbers of points on one line from one end to the other.
Indices order_along_line(std::span<const Point> points) {
    Indices order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(points[a].x, points[a].y) < std::pair(points[b].x, points[b].y);
    });
    return order;
}

Indices hull_of(std::span<const Triangle> triangles, std::span<const std::uint32_t> twins) {
    Indices hull;
    for (const std::uint32_t h : boundary_loops(twins).items) hull.push_back(origin(triangles, h).value);
    return hull;
}

/// Returns per half-edge whether it lies on one of the edges.
std::vector<std::uint8_t> marks_of(std::size_t points, std::span<const Triangle> triangles,
                                   std::span<const std::uint32_t> twins, std::span<const Segment> edges) {
    std::vector<std::uint8_t> marks(twins.size(), 0);
    if (edges.empty()) return marks;
    const IndexLists fans = half_edges_at_points(points, triangles, twins);
    for (const Segment& edge : edges)
        for (const VertexId from : {edge.a, edge.b}) {
            const VertexId to = from == edge.a ? edge.b : edge.a;
            for (const std::uint32_t h : fans[from.index()]) {
                if (origin(triangles, next_half_edge(h)) != to) continue;
                marks[h] = 1;
                if (twins[h] != no_half_edge) marks[twins[h]] = 1;
            }
        }
    return marks;
}

Arrays triangulate_distinct(std::span<const Point> given, std::span<const Segment> segments) {
    const DistinctPoints kept = distinct_points(given);
    const auto distinct = [&](VertexId v) { return v.index() < given.size() ? VertexId{kept.distinct[v.index()]} : v; };
    std::vector<Segment> between;
    for (const Segment& segment : segments) between.push_back({distinct(segment.a), distinct(segment.b)});
    ConstrainedTriangulation made;
    if (between.empty())
        made.triangles = triangulate(kept.points).triangles;
    else
        made = triangulate(kept.points, between);
    Arrays result{.triangles = std::move(made.triangles)};
    for (Triangle& triangle : result.triangles) std::swap(triangle.v[1], triangle.v[2]);
    result.halfedges = half_edges(kept.points.size(), result.triangles);
    result.constrained = marks_of(kept.points.size(), result.triangles, result.halfedges, made.segments);
    result.hull =
        result.triangles.empty() ? order_along_line(kept.points) : hull_of(result.triangles, result.halfedges);
    for (Triangle& triangle : result.triangles)
        for (VertexId& v : triangle.v) v = VertexId{kept.original[v.index()]};
    for (std::uint32_t& v : result.hull) v = kept.original[v];
    return result;
}

/// The address of an array in the memory of the module, which has 32 bits.
std::uint32_t address(const void* array) { return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(array)); }

}  // namespace

extern "C" {

/// Returns the arrays of points (x, y, x, y, ...) and segments (from, to, from, to, ...), to be freed by release().
View* triangulate_arrays(const double* coordinates, std::uint32_t points, const std::uint32_t* ends,
                         std::uint32_t segments) {
    auto* view = new View{};
    try {
        std::vector<Point> given(points);
        for (std::uint32_t i = 0; i < points; ++i) given[i] = {coordinates[2 * i], coordinates[2 * i + 1]};
        std::vector<Segment> between(segments);
        for (std::uint32_t i = 0; i < segments; ++i) between[i] = {VertexId{ends[2 * i]}, VertexId{ends[2 * i + 1]}};
        view->arrays = triangulate_distinct(given, between);
    } catch (const std::exception& e) {
        view->arrays.error = e.what();
    }
    const Arrays& arrays = view->arrays;
    view->triangles = address(arrays.triangles.data());
    view->corners = static_cast<std::uint32_t>(3 * arrays.triangles.size());
    view->halfedges = address(arrays.halfedges.data());
    view->constrained = address(arrays.constrained.data());
    view->hull = address(arrays.hull.data());
    view->hull_size = static_cast<std::uint32_t>(arrays.hull.size());
    view->error = address(arrays.error.data());
    view->error_size = static_cast<std::uint32_t>(arrays.error.size());
    return view;
}

/// Returns where the eight numbers of a view stand, in the order of View.
const std::uint32_t* numbers_of_view(const View* view) { return &view->triangles; }

void release(View* view) { delete view; }
}
