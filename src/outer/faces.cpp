// Face tracing by turning as far left as possible at every vertex; M. de Berg et al., Computational Geometry (2008),
// chapter 2 (doubly-connected edge lists). Angular comparisons are exact.
#include "outer/faces.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "core/predicates.hpp"

namespace lamina::outer {

namespace {

/// Upper half plane first (angle in [0, pi)), counter-clockwise inside a half.
bool angle_less(Point origin, Point a, Point b) {
    const auto lower = [&](Point p) { return p.y < origin.y || (p.y == origin.y && p.x < origin.x); };
    if (lower(a) != lower(b)) return lower(b);
    return detail::inline_orient2d(origin, a, b) > 0;
}

/// Is p inside the closed loop of edges? Exact crossing count along the ray to +x.
bool inside(std::span<const Point> points, std::span<const Segment> loop, Point p) {
    bool in = false;
    for (const Segment& s : loop) {
        const Point a = points[s.a.index()], b = points[s.b.index()];
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        const double side = detail::inline_orient2d(a, b, p);
        if (b.y > a.y ? side > 0 : side < 0) in = !in;
    }
    return in;
}

double doubled_area(std::span<const Point> points, const std::vector<Segment>& loop) {
    // Relative to a vertex of the loop: far from the origin the products would cancel.
    const Point o = points[loop.front().a.index()];
    double area = 0;
    for (const Segment& s : loop) area += cross(points[s.a.index()] - o, points[s.b.index()] - o);
    return area;
}

/// Edges leaving each vertex, counter-clockwise, as places in `edges`.
struct Star {
    std::vector<std::size_t> start;  ///< per vertex, one more
    std::vector<std::uint32_t> edge;
};

Star leaving_edges(std::span<const Point> points, std::span<const Segment> edges) {
    Star star;
    star.start.assign(points.size() + 1, 0);
    for (const Segment& e : edges) ++star.start[e.a.index() + 1];
    for (std::size_t v = 0; v < points.size(); ++v) star.start[v + 1] += star.start[v];
    star.edge.resize(edges.size());
    std::vector<std::size_t> fill(star.start.begin(), star.start.end() - 1);
    for (std::uint32_t e = 0; e < edges.size(); ++e) star.edge[fill[edges[e].a.index()]++] = e;
    for (std::size_t v = 0; v < points.size(); ++v) {
        std::sort(star.edge.begin() + static_cast<std::ptrdiff_t>(star.start[v]),
                  star.edge.begin() + static_cast<std::ptrdiff_t>(star.start[v + 1]),
                  [&](std::uint32_t l, std::uint32_t r) {
                      return angle_less(points[v], points[edges[l].b.index()], points[edges[r].b.index()]);
                  });
    }
    return star;
}

/// The edge that follows e round the face on its left: of those leaving its end, the first one clockwise from the way
/// back.
///
///        following
///            ^   .
///            |  /          the way back is the edge drawn dotted;
///    e.a --> v ..          turning clockwise from it, `following` comes first
std::uint32_t following(std::span<const Point> points, std::span<const Segment> edges, const Star& star,
                        std::uint32_t e) {
    const auto [u, v] = edges[e];
    const std::size_t begin = star.start[v.index()], end = star.start[v.index() + 1];
    assert(begin < end);
    // The last edge with a smaller angle than the way back, cyclically.
    std::size_t k = begin;
    while (k < end && angle_less(points[v.index()], points[edges[star.edge[k]].b.index()], points[u.index()])) ++k;
    return star.edge[k == begin ? end - 1 : k - 1];
}

}  // namespace

std::vector<Face> trace_faces(std::span<const Point> points, std::span<const Segment> edges) {
    const Star star = leaving_edges(points, edges);
    std::vector<Face> faces;
    std::vector<std::vector<Segment>> holes;
    std::vector<char> done(edges.size(), 0);
    for (std::uint32_t first = 0; first < edges.size(); ++first) {
        if (done[first]) continue;
        std::vector<Segment> loop;
        for (std::uint32_t e = first; !done[e]; e = following(points, edges, star, e)) {
            done[e] = 1;
            loop.push_back(edges[e]);
        }
        if (doubled_area(points, loop) > 0)
            faces.push_back({std::move(loop)});
        else
            holes.push_back(std::move(loop));
    }
    // Faces do not overlap, so the outer loops that hold a hole are nested; the innermost has the smallest area.
    std::vector<double> area;
    for (const Face& f : faces) area.push_back(doubled_area(points, f.edges));
    std::vector<std::size_t> outer_edges;
    for (const Face& f : faces) outer_edges.push_back(f.edges.size());
    for (const std::vector<Segment>& hole : holes) {
        std::size_t owner = faces.size();
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const auto outer = std::span<const Segment>(faces[f].edges).first(outer_edges[f]);
            if (inside(points, outer, points[hole.front().a.index()]) &&
                (owner == faces.size() || area[f] < area[owner]))
                owner = f;
        }
        if (owner < faces.size()) faces[owner].edges.insert(faces[owner].edges.end(), hole.begin(), hole.end());
    }
    return faces;
}

}  // namespace lamina::outer
