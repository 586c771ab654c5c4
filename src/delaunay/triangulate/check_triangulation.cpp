// An independent check of triangulations: it shares nothing with the code that makes them but the predicates.
#include <algorithm>
#include <unordered_map>

#include <lamina/predicates.hpp>
#include <lamina/triangulation.hpp>

#include "core/arguments.hpp"
#include "core/cell_shape.hpp"
#include "core/text.hpp"

namespace lamina::delaunay {

namespace {

constexpr std::size_t max_defects = 20;

/// The edge a -> b of a triangle, which lies on its left.
struct TriangleEdge {
    std::uint32_t a, b;
    std::uint32_t triangle;
    std::uint32_t apex;  ///< the third vertex of the triangle
};

std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

/// The first defects that were found, one line each.
struct TriangulationDefects {
    std::vector<std::string> lines;
    void add(std::string line) {
        if (lines.size() < max_defects) lines.push_back(std::move(line));
    }
};

/// Reports indices out of range and triangles that are not counter-clockwise. Returns false for indices out of range:
/// then nothing else can be checked.
bool check_triangles(std::span<const Point> points, std::span<const Triangle> triangles,
                     TriangulationDefects& defects) {
    bool usable = true;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& v = triangles[t].v;
        if (std::any_of(v, v + 3, [&](VertexId i) { return i.index() >= points.size(); })) {
            defects.add(core::concat("triangle ", t, ": vertex index out of range"));
            usable = false;
        } else if (!(orient2d(points[v[0].index()], points[v[1].index()], points[v[2].index()]) > 0)) {
            defects.add(core::concat("triangle ", t, " (", v[0].value, ", ", v[1].value, ", ", v[2].value,
                                     ") is not counter-clockwise"));
        }
    }
    return usable;
}

/// Returns the edges of all triangles, sorted by a and b.
std::vector<TriangleEdge> sorted_edges(std::span<const Triangle> triangles) {
    std::vector<TriangleEdge> edges;
    edges.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& v = triangles[t].v;
        for (int e = 0; e < 3; ++e)
            edges.push_back({v[(e + 1) % 3].value, v[(e + 2) % 3].value, static_cast<std::uint32_t>(t), v[e].value});
    }
    std::sort(edges.begin(), edges.end(),
              [](const TriangleEdge& l, const TriangleEdge& r) { return key(l.a, l.b) < key(r.a, r.b); });
    return edges;
}

/// Returns the first of the sorted edges from a to b, or nullptr if there is none.
const TriangleEdge* find(const std::vector<TriangleEdge>& edges, std::uint32_t a, std::uint32_t b) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), key(a, b),
                                     [](const TriangleEdge& e, std::uint64_t k) { return key(e.a, e.b) < k; });
    return at != edges.end() && at->a == a && at->b == b ? &*at : nullptr;
}

/// Reports vertices round which triangles overlap: no direction from a vertex, inside or on the boundary, may be
/// covered twice. Counter-clockwise triangles that use each edge once in each direction cover all directions from an
/// inner vertex equally often, so one direction speaks for all. The test counts, exactly, the triangles whose sector at
/// the vertex holds the direction of +x.
void check_overlaps(std::span<const Point> points, std::span<const Triangle> triangles, TriangulationDefects& defects) {
    std::vector<std::uint32_t> covering(points.size(), 0);
    for (const Triangle& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            const Point p = points[t.v[i].index()], a = points[t.v[(i + 1) % 3].index()],
                        b = points[t.v[(i + 2) % 3].index()];
            // The sector from a to b, seen from p, is half-open: it holds the ray from p in the direction of +x if a
            // lies on the ray or below it and b strictly above it.
            const bool a_below = a.y < p.y || (a.y == p.y && a.x > p.x);
            const bool b_above = b.y > p.y || (b.y == p.y && b.x < p.x);
            if (a_below && b_above) ++covering[t.v[i].index()];
        }
    }
    for (std::size_t v = 0; v < points.size(); ++v)
        if (covering[v] > 1)
            defects.add(core::concat("the triangles round vertex ", v, " overlap (", covering[v], " turns)"));
}

/// Reports edges that are neither locally Delaunay nor among the constraints, which are sorted keys of (smaller vertex,
/// larger vertex).
void check_delaunay(std::span<const Point> points, const std::vector<TriangleEdge>& edges,
                    const std::vector<std::uint64_t>& constraints, TriangulationDefects& defects) {
    for (const TriangleEdge& e : edges) {
        if (e.a > e.b) continue;
        const TriangleEdge* other = find(edges, e.b, e.a);
        if (!other || std::binary_search(constraints.begin(), constraints.end(), key(e.a, e.b))) continue;
        if (incircle_perturbed(points[e.a], points[e.b], points[e.apex], points[other->apex]) > 0)
            defects.add(core::concat("edge ", e.a, "-", e.b, " is not Delaunay: vertex ", other->apex,
                                     " lies in the circle of triangle ", e.triangle));
    }
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

std::vector<std::string> check_triangulation(std::span<const Point> points, std::span<const Triangle> triangles,
                                             std::span<const Segment> constraints,
                                             const TriangulationCheckOptions& options) {
    TriangulationDefects defects;
    if (!check_triangles(points, triangles, defects)) return defects.lines;
    const std::vector<TriangleEdge> edges = sorted_edges(triangles);
    for (std::size_t i = 1; i < edges.size(); ++i)
        if (edges[i].a == edges[i - 1].a && edges[i].b == edges[i - 1].b)
            defects.add(core::concat("edge ", edges[i].a, " -> ", edges[i].b, " belongs to triangles ",
                                     edges[i - 1].triangle, " and ", edges[i].triangle));
    if (!defects.lines.empty()) return defects.lines;

    check_overlaps(points, triangles, defects);
    std::vector<std::uint64_t> constrained;
    constrained.reserve(constraints.size());
    for (const Segment& s : constraints) {
        constrained.push_back(key(std::min(s.a, s.b).value, std::max(s.a, s.b).value));
        if (!find(edges, s.a.value, s.b.value) && !find(edges, s.b.value, s.a.value))
            defects.add(core::concat("constraint ", s.a.value, "-", s.b.value, " is no edge"));
    }
    std::sort(constrained.begin(), constrained.end());
    if (options.require_delaunay) check_delaunay(points, edges, constrained, defects);
    return defects.lines;
}

double smallest_angle_deg(std::span<const Point> points, std::span<const Triangle> triangles) {
    core::require_indices_below(points.size(), triangles);
    double smallest = triangles.empty() ? 0 : 180;
    for (const Triangle& t : triangles) {
        const auto at = [&](int i) { return points[t.v[i].index()]; };
        smallest = std::min(smallest, core::measure_triangle(at(0), at(1), at(2)).min_angle_deg);
    }
    return smallest;
}

}  // namespace lamina
