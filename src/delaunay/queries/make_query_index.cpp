// Triangles are linked, what lies outside is triangulated from the boundary, and all is numbered along a curve.
#include <algorithm>
#include <limits>
#include <numeric>

#include <lamina/delaunay_connectivity.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/bounding_box.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/queries/query_index.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"
#include "delaunay/triangulate/walk.hpp"

namespace lamina::delaunay::queries {

namespace {

constexpr std::size_t query_grain = 1 << 14;

/// An edge of the boundary, with the region on its left.
struct BoundaryEdge {
    std::uint64_t ends;  ///< its first vertex, then its second one
    Link link;           ///< the triangle on its left, and its edge
};

std::uint64_t directed_key(Index a, Index b) { return std::uint64_t{a} << 32 | b; }

/// Returns the edge of a triangle that a half-edge is.
unsigned edge_of(std::uint32_t half_edge) { return previous(half_edge % 3); }

std::vector<BoundaryEdge> boundary_edges(std::span<const Triangle> triangles, std::span<const std::uint32_t> twins) {
    std::vector<BoundaryEdge> edges;
    for (std::uint32_t h = 0; h < twins.size(); ++h)
        if (twins[h] == no_half_edge)
            edges.push_back({directed_key(origin(triangles, h).value, origin(triangles, next_half_edge(h)).value),
                             Link(h / 3, edge_of(h))});
    std::sort(edges.begin(), edges.end(), [](const BoundaryEdge& s, const BoundaryEdge& t) { return s.ends < t.ends; });
    return edges;
}

[[noreturn]] void fail_boundary(const InputPlace& place) {
    throw InputError(place, "the triangles overlap, or do not fit together along their boundary");
}

/// Returns the triangles and ghosts outside the region, in the numbers of the points; no edge is constrained, and links
/// to the region are borders.
Tris triangulate_outside(std::span<const Point> points, const std::vector<BoundaryEdge>& boundary) {
    std::vector<Index> used;
    used.reserve(boundary.size());
    for (const BoundaryEdge& e : boundary) used.push_back(static_cast<Index>(e.ends >> 32));
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto local = [&](std::uint64_t v) {
        const auto at = std::lower_bound(used.begin(), used.end(), static_cast<Index>(v));
        return VertexId{static_cast<std::size_t>(at - used.begin())};
    };
    std::vector<Point> corners;
    corners.reserve(used.size());
    for (const Index v : used) corners.push_back(points[v]);
    std::vector<Segment> segments;
    segments.reserve(boundary.size());
    for (const BoundaryEdge& e : boundary) segments.push_back({local(e.ends >> 32), local(e.ends & 0xffffffffu)});
    Tris tris = triangulate_points(corners);
    try {
        insert_segments(corners, segments, tris);
    } catch (const InputError& e) {
        InputPlace place{.at = e.place().at};
        for (const std::size_t v : e.place().points) place.points.push_back(used[v]);
        fail_boundary(place);
    }
    TriangleSelection outside = select_left_of_segments(segments, tris, corners.size());
    for (char& selected : outside) selected = !selected;
    tris = keep_selected(tris, outside);
    for (Tri& t : tris)
        for (Index& v : t.v)
            if (v != ghost_vertex) v = used[v];
    return tris;
}

/// All triangles in the numbers of the points, those of the region first.
Tris link_all(std::span<const Point> points, std::span<const Triangle> triangles,
              std::span<const std::uint32_t> twins) {
    const std::vector<BoundaryEdge> boundary = boundary_edges(triangles, twins);
    const Tris outside = triangulate_outside(points, boundary);
    Tris tris(triangles.size() + outside.size());
    core::parallel_for(triangles.size(), query_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            for (unsigned e = 0; e < 3; ++e) {
                tris[t].v[e] = triangles[t].v[e].value;
                const std::uint32_t twin = twins[3 * t + next(e)];
                if (twin != no_half_edge) tris[t].n[e] = Link(twin / 3, edge_of(twin));
            }
    });
    const auto offset = static_cast<Index>(triangles.size());
    std::size_t joined = 0;
    for (Index t = 0; t < outside.size(); ++t) {
        for (unsigned e = 0; e < 3; ++e) {
            tris[offset + t].v[e] = outside[t].v[e];
            const Link n = outside[t].n[e];
            if (!n.is_border()) tris[offset + t].n[e] = Link(offset + n.triangle(), n.edge());
        }
        for (unsigned e = 0; e < 3; ++e) {
            if (!outside[t].n[e].is_border()) continue;
            // The region has the same edge the other way round.
            const std::uint64_t ends = directed_key(outside[t].v[previous(e)], outside[t].v[next(e)]);
            const auto edge = std::lower_bound(boundary.begin(), boundary.end(), ends,
                                               [](const BoundaryEdge& b, std::uint64_t k) { return b.ends < k; });
            if (edge == boundary.end() || edge->ends != ends) fail_boundary({});
            connect(tris, offset + t, e, edge->link);
            ++joined;
        }
    }
    if (joined != boundary.size()) fail_boundary({});
    return tris;
}

/// Sorts the used points along the curve and numbers them from 1. Returns for each point its number, or 0.
std::vector<Index> number_vertices_along_curve(std::span<const Point> points, const Tris& tris, QueryIndex& index) {
    std::vector<Index> numbers(points.size(), 0);
    for (const Tri& t : tris)
        for (const Index v : t.v)
            if (v != ghost_vertex) numbers[v] = 1;
    std::vector<Index> used;
    std::vector<Point> used_points;
    for (Index v = 0; v < numbers.size(); ++v) {
        if (numbers[v] == 0) continue;
        used.push_back(v);
        used_points.push_back(points[v]);
    }
    VerticesAlongCurve& along = index.along_curve;
    along.box = core::bounding_box(used_points);
    along.curve = HilbertCurve<curve_bits>(along.box);
    const CurveOrder order(used_points, along.curve);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    index.vertices.assign(1, {nan, nan});
    index.point_ids.assign(1, no_index);
    index.vertices.reserve(used.size() + 1);
    index.point_ids.reserve(used.size() + 1);
    along.keys.reserve(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        const std::size_t from = order[i];
        index.vertices.push_back(used_points[from]);
        index.point_ids.push_back(used[from]);
        along.keys.push_back(order.key_at(i));
        numbers[used[from]] = static_cast<Index>(i + 1);
    }
    along.key_shift = order.key_shift();
    return numbers;
}

/// Makes a table of where keys begin, with about four keys for each of its entries.
void make_buckets(VerticesAlongCurve& along) {
    const unsigned key_bits = 2 * curve_bits - along.key_shift;
    const auto bucket_bits = std::min(key_bits, static_cast<unsigned>(std::bit_width(along.keys.size() / 4)));
    along.bucket_shift = key_bits - bucket_bits;
    along.bucket_starts.assign((std::size_t{1} << bucket_bits) + 1, 0);
    for (const std::uint64_t key : along.keys) ++along.bucket_starts[(key >> along.bucket_shift) + 1];
    std::partial_sum(along.bucket_starts.begin(), along.bucket_starts.end(), along.bucket_starts.begin());
}

/// Copies the triangles to index.tris, sorted by their first vertices along the curve.
void order_triangles(const Tris& tris, std::size_t inside, const std::vector<Index>& numbers, QueryIndex& index) {
    const auto number = [&](Index v) { return v == ghost_vertex ? growing_ghost_vertex : numbers[v]; };
    const auto first_vertex = [&](const Tri& t) {
        // Ghosts count by their hull edge; 0 stands for infinity, and no_index is the largest number.
        const auto order = [&](Index v) { return v == ghost_vertex ? no_index : numbers[v]; };
        return std::min({order(t.v[0]), order(t.v[1]), order(t.v[2])});
    };
    std::vector<Index> starts(index.vertices.size() + 1, 0);
    for (const Tri& t : tris) ++starts[first_vertex(t) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<Index> place(tris.size());
    for (Index t = 0; t < tris.size(); ++t) place[t] = starts[first_vertex(tris[t])]++;
    index.tris.resize(tris.size());
    index.triangle_ids.resize(tris.size());
    core::parallel_for(tris.size(), query_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            Tri& copy = index.tris[place[t]];
            for (unsigned e = 0; e < 3; ++e) {
                copy.v[e] = number(tris[t].v[e]);
                copy.n[e] = Link(place[tris[t].n[e].triangle()], tris[t].n[e].edge());
            }
            index.triangle_ids[place[t]] = t < inside ? static_cast<Index>(t) : no_index;
        }
    });
    index.places.assign(place.begin(), place.begin() + static_cast<std::ptrdiff_t>(inside));
    index.at_vertex.assign(index.vertices.size(), no_index);
    for (std::size_t t = inside; t-- > 0;)
        for (const Index v : index.tris[place[t]].v) index.at_vertex[v] = place[t];
}

bool is_delaunay_triangulation(const QueryIndex& index) {
    const auto is_bad = [&](std::size_t begin, std::size_t end) -> char {
        for (Index t = static_cast<Index>(begin); t < end; ++t) {
            const Tri& tri = index.tris[t];
            if (!index.is_inside(t) && !is_growing_ghost(tri)) return true;
            if (!index.is_inside(t)) continue;
            const Point* const p = index.vertices.data();
            for (const Link n : tri.n) {
                if (n.triangle() < t || !index.is_inside(n.triangle())) continue;
                if (incircle(p[tri.v[0]], p[tri.v[1]], p[tri.v[2]], p[index.tris[n.triangle()].v[n.edge()]]) > 0)
                    return true;
            }
        }
        return false;
    };
    const auto bad = core::parallel_blocks(index.tris.size(), query_grain, is_bad);
    return std::find(bad.begin(), bad.end(), 1) == bad.end();
}

}  // namespace

QueryIndex make_query_index(std::span<const Point> points, std::span<const Triangle> triangles) {
    check_points(points);
    const std::vector<std::uint32_t> twins = half_edges(points.size(), triangles);
    require_counter_clockwise(points, triangles);
    QueryIndex index;
    index.point_count = points.size();
    if (triangles.empty()) return index;
    const Tris tris = link_all(points, triangles, twins);
    const std::vector<Index> numbers = number_vertices_along_curve(points, tris, index);
    make_buckets(index.along_curve);
    order_triangles(tris, triangles.size(), numbers, index);
    index.is_delaunay = is_delaunay_triangulation(index);
    return index;
}

}  // namespace lamina::delaunay::queries
