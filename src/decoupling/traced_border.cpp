// Borders are traced by turning as far left as possible at every vertex: M. de Berg et al., Computational Geometry
// (2008), chapter 2 (doubly-connected edge lists). Comparisons of angles are exact.
#include "decoupling/traced_border.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "core/parallel.hpp"
#include "core/predicates.hpp"

namespace lamina::decoupling {

namespace {

/// Returns whether a comes before b in the counter-clockwise order round the origin that starts with the positive x
/// axis.
bool angle_less(Point origin, Point a, Point b) {
    const auto in_lower_half = [&](Point p) { return p.y < origin.y || (p.y == origin.y && p.x < origin.x); };
    if (in_lower_half(a) != in_lower_half(b)) return in_lower_half(b);
    return core::inline_orient2d(origin, a, b) > 0;
}

/// A loop of edges.
struct EdgeLoop {
    std::span<const Point> points;
    std::span<const Segment> edges;
    std::span<const std::uint32_t> loop;

    std::size_t size() const { return loop.size(); }
    VertexId begin(std::size_t i) const { return edges[loop[i]].a; }
    Point at(std::size_t i) const { return points[begin(i).index()]; }
    bool has(VertexId v) const {
        return std::any_of(loop.begin(), loop.end(), [&](std::uint32_t e) { return edges[e].a == v; });
    }
};

/// Returns whether p lies inside the closed loop: an exact count of crossings of the ray from p to +x.
bool is_inside(const EdgeLoop& loop, Point p) {
    bool inside = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point a = loop.at(i), b = loop.at(i + 1 < loop.size() ? i + 1 : 0);
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        const double side = core::inline_orient2d(a, b, p);
        if (b.y > a.y ? side > 0 : side < 0) inside = !inside;
    }
    return inside;
}

/// Returns twice the area inside a loop. Edges that dangle occur in both directions and are left out: their terms
/// cancel but for rounding, which would give a tree of lines an area.
double doubled_area(const EdgeLoop& loop) {
    std::vector<Segment> sorted;
    for (const std::uint32_t e : loop.loop) sorted.push_back(loop.edges[e]);
    std::sort(sorted.begin(), sorted.end());
    // Coordinates are relative to a vertex of the loop, because far from the origin the products would cancel.
    const Point o = loop.at(0);
    double area = 0;
    for (const std::uint32_t e : loop.loop) {
        const auto [a, b] = loop.edges[e];
        if (!std::binary_search(sorted.begin(), sorted.end(), Segment{b, a}))
            area += cross(loop.points[a.index()] - o, loop.points[b.index()] - o);
    }
    return area;
}

/// Directed edges with, for each vertex, the edges that leave it.
class EdgeFans {
public:
    EdgeFans(std::span<const Point> points, std::span<const Segment> edges)
        : points_(points), edges_(edges), first_(points.size() + 1, 0), fans_(edges.size()) {
        for (const Segment& e : edges) ++first_[e.a.index() + 1];
        for (std::size_t v = 0; v < points.size(); ++v) first_[v + 1] += first_[v];
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t e = 0; e < edges.size(); ++e) fans_[next[edges[e].a.index()]++] = e;
        core::parallel_for(points.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v)
                std::sort(fans_.begin() + static_cast<std::ptrdiff_t>(first_[v]),
                          fans_.begin() + static_cast<std::ptrdiff_t>(first_[v + 1]),
                          [&](std::uint32_t l, std::uint32_t r) {
                              return angle_less(points[v], points[edges[l].b.index()], points[edges[r].b.index()]);
                          });
        });
    }

    /// Returns the edge that follows the edge u-v round the region on its left: of the edges that leave v, the first
    /// one clockwise from the edge v-u.
    ///
    ///          following
    ///              ^   .
    ///              |  .          another edge that leaves v; it comes later in the clockwise order
    ///      u ----> v .
    std::uint32_t following(std::uint32_t edge) const {
        const auto [u, v] = edges_[edge];
        const std::size_t begin = first_[v.index()], end = first_[v.index() + 1];
        assert(begin < end);
        // It is the last edge with a smaller angle than v-u, cyclically.
        std::size_t k = begin;
        while (k < end && angle_less(points_[v.index()], points_[edges_[fans_[k]].b.index()], points_[u.index()])) ++k;
        return fans_[k == begin ? end - 1 : k - 1];
    }

private:
    std::span<const Point> points_;
    std::span<const Segment> edges_;
    std::vector<std::size_t> first_;   ///< for each vertex where its fan begins, and the number of edges
    std::vector<std::uint32_t> fans_;  ///< indices of the edges that leave each vertex, counter-clockwise
};

/// Returns all loops, each with the region of its edges on its left, in the order of their lowest-numbered edges.
std::vector<std::vector<std::uint32_t>> trace_loops(std::span<const Point> points, std::span<const Segment> edges) {
    const EdgeFans fans(points, edges);
    std::vector<std::vector<std::uint32_t>> loops;
    std::vector<char> done(edges.size(), 0);
    for (std::uint32_t first = 0; first < edges.size(); ++first) {
        if (done[first]) continue;
        std::vector<std::uint32_t>& loop = loops.emplace_back();
        for (std::uint32_t e = first; !done[e]; e = fans.following(e)) {
            done[e] = 1;
            loop.push_back(e);
        }
        // No two edges are followed by the same one, so the loop is back where it began.
        assert(fans.following(loop.back()) == first);
    }
    return loops;
}

/// Returns the index of the border that a hole belongs to, or the number of borders if the hole bounds the unbounded
/// region. `areas` are the doubled areas of the outer loops.
std::size_t find_owner(const EdgeLoop& hole, std::span<const TracedBorder> borders, std::span<const double> areas) {
    std::size_t owner = borders.size();
    for (std::size_t i = 0; i < borders.size(); ++i) {
        // Subdomains inside the hole have its vertices on their borders.
        const EdgeLoop outer{hole.points, hole.edges, borders[i].loops.front()};
        if (!outer.has(hole.begin(0)) && is_inside(outer, hole.at(0)) &&
            (owner == borders.size() || areas[i] < areas[owner]))
            owner = i;
    }
    return owner;
}

}  // namespace

std::vector<TracedBorder> trace_borders(std::span<const Point> points, std::span<const Segment> edges) {
    std::vector<TracedBorder> borders;
    std::vector<double> areas;
    std::vector<std::vector<std::uint32_t>> holes;
    for (std::vector<std::uint32_t>& loop : trace_loops(points, edges)) {
        if (const double area = doubled_area({points, edges, loop}); area > 0) {
            borders.push_back({{std::move(loop)}});
            areas.push_back(area);
        } else {
            holes.push_back(std::move(loop));
        }
    }
    // Subdomains do not overlap, so the outer loops round a hole are nested; the innermost one has the smallest area.
    for (std::vector<std::uint32_t>& hole : holes) {
        const std::size_t owner = find_owner({points, edges, hole}, borders, areas);
        if (owner < borders.size()) borders[owner].loops.push_back(std::move(hole));
    }
    return borders;
}

}  // namespace lamina::decoupling
