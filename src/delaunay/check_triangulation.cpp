// An independent look at a triangulation: knows nothing of links, cavities or orders of insertion.
#include <algorithm>
#include <unordered_map>

#include <lamina/delaunay.hpp>
#include <lamina/predicates.hpp>

#include "core/cell_shape.hpp"
#include "core/text.hpp"

namespace lamina::delaunay {

namespace {

constexpr std::size_t reported_defects = 20;

struct DirectedEdge {
    std::uint32_t a, b;
    std::uint32_t triangle, apex;
};

std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

struct Report {
    std::vector<std::string> defects;
    void add(std::string text) {
        if (defects.size() < reported_defects) defects.push_back(std::move(text));
    }
};

bool check_triangles(std::span<const Point> points, std::span<const Triangle> triangles, Report& report) {
    bool usable = true;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& v = triangles[t].v;
        if (std::any_of(v, v + 3, [&](VertexId i) { return i.index() >= points.size(); })) {
            report.add(core::concat("triangle ", t, ": vertex index out of range"));
            usable = false;
        } else if (!(orient2d(points[v[0].index()], points[v[1].index()], points[v[2].index()]) > 0)) {
            report.add(core::concat("triangle ", t, " (", v[0].value, ", ", v[1].value, ", ", v[2].value,
                                    ") is not counter-clockwise"));
        }
    }
    return usable;
}

std::vector<DirectedEdge> sorted_edges(std::span<const Triangle> triangles) {
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& v = triangles[t].v;
        for (int e = 0; e < 3; ++e)
            edges.push_back({v[(e + 1) % 3].value, v[(e + 2) % 3].value, static_cast<std::uint32_t>(t), v[e].value});
    }
    std::sort(edges.begin(), edges.end(),
              [](const DirectedEdge& l, const DirectedEdge& r) { return key(l.a, l.b) < key(r.a, r.b); });
    return edges;
}

const DirectedEdge* find(const std::vector<DirectedEdge>& edges, std::uint32_t a, std::uint32_t b) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), key(a, b),
                                     [](const DirectedEdge& e, std::uint64_t k) { return key(e.a, e.b) < k; });
    return at != edges.end() && at->a == a && at->b == b ? &*at : nullptr;
}

/// Round a vertex, inside or on the rim, no direction is covered twice. Between counter-clockwise triangles that use
/// each edge once in each direction the direction of +x tells for all of them at an inner vertex: the exact test is the
/// count of triangles whose angular range there holds it.
void check_turning(std::span<const Point> points, std::span<const Triangle> triangles, Report& report) {
    std::vector<std::uint32_t> covering(points.size(), 0);
    for (const Triangle& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            const Point p = points[t.v[i].index()], a = points[t.v[(i + 1) % 3].index()],
                        b = points[t.v[(i + 2) % 3].index()];
            // Half-open sector [a, b) seen from p: a is at or below the ray, b strictly above it, turning through it.
            const bool a_below = a.y < p.y || (a.y == p.y && a.x > p.x);
            const bool b_above = b.y > p.y || (b.y == p.y && b.x < p.x);
            if (a_below && b_above) ++covering[t.v[i].index()];
        }
    }
    for (std::size_t v = 0; v < points.size(); ++v)
        if (covering[v] > 1)
            report.add(core::concat("the triangles round vertex ", v, " overlap (", covering[v], " turns)"));
}

void check_delaunay(std::span<const Point> points, const std::vector<DirectedEdge>& edges,
                    const std::vector<std::uint64_t>& constraints, Report& report) {
    for (const DirectedEdge& e : edges) {
        if (e.a > e.b) continue;
        const DirectedEdge* other = find(edges, e.b, e.a);
        if (!other || std::binary_search(constraints.begin(), constraints.end(), key(e.a, e.b))) continue;
        if (incircle_perturbed(points[e.a], points[e.b], points[e.apex], points[other->apex]) > 0)
            report.add(core::concat("edge ", e.a, "-", e.b, " is not Delaunay: vertex ", other->apex,
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
    Report report;
    if (!check_triangles(points, triangles, report)) return report.defects;
    const std::vector<DirectedEdge> edges = sorted_edges(triangles);
    for (std::size_t i = 1; i < edges.size(); ++i)
        if (edges[i].a == edges[i - 1].a && edges[i].b == edges[i - 1].b)
            report.add(core::concat("edge ", edges[i].a, " -> ", edges[i].b, " belongs to triangles ",
                                    edges[i - 1].triangle, " and ", edges[i].triangle));
    if (!report.defects.empty()) return report.defects;

    check_turning(points, triangles, report);
    std::vector<std::uint64_t> fixed;
    for (const Segment& s : constraints) {
        fixed.push_back(key(std::min(s.a, s.b).value, std::max(s.a, s.b).value));
        if (!find(edges, s.a.value, s.b.value) && !find(edges, s.b.value, s.a.value))
            report.add(core::concat("constraint ", s.a.value, "-", s.b.value, " is no edge"));
    }
    std::sort(fixed.begin(), fixed.end());
    if (options.require_delaunay) check_delaunay(points, edges, fixed, report);
    return report.defects;
}

double smallest_angle_deg(std::span<const Point> points, std::span<const Triangle> triangles) {
    double smallest = triangles.empty() ? 0 : 180;
    for (const Triangle& t : triangles) {
        const auto at = [&](int i) { return points[t.v[i].index()]; };
        smallest = std::min(smallest, core::measure_triangle(at(0), at(1), at(2)).min_angle_deg);
    }
    return smallest;
}

}  // namespace lamina
