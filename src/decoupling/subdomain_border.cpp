// Borders are traced by turning as far left as possible at every vertex: M. de Berg et al., Computational Geometry
// (2008), chapter 2 (doubly-connected edge lists). Comparisons of angles are exact.
#include "decoupling/subdomain_border.hpp"

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

/// Returns whether p lies inside the closed loop: an exact count of crossings of the ray from p to +x.
bool is_inside(std::span<const Point> points, std::span<const VertexId> loop, Point p) {
    bool inside = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point a = points[loop[i].index()], b = points[loop[i + 1 < loop.size() ? i + 1 : 0].index()];
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        const double side = core::inline_orient2d(a, b, p);
        if (b.y > a.y ? side > 0 : side < 0) inside = !inside;
    }
    return inside;
}

double doubled_area(std::span<const Point> points, std::span<const VertexId> loop) {
    // Coordinates are relative to a vertex of the loop, because far from the origin the products would cancel.
    const Point o = points[loop.front().index()];
    double area = 0;
    for (std::size_t i = 0; i + 1 < loop.size(); ++i)
        area += cross(points[loop[i].index()] - o, points[loop[i + 1].index()] - o);
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
std::vector<std::vector<VertexId>> trace_loops(std::span<const Point> points, std::span<const Segment> edges) {
    const EdgeFans fans(points, edges);
    std::vector<std::vector<VertexId>> loops;
    std::vector<char> done(edges.size(), 0);
    for (std::uint32_t first = 0; first < edges.size(); ++first) {
        if (done[first]) continue;
        std::vector<VertexId>& loop = loops.emplace_back();
        for (std::uint32_t e = first; !done[e]; e = fans.following(e)) {
            done[e] = 1;
            loop.push_back(edges[e].a);
        }
    }
    return loops;
}

/// Returns the index of the border that a hole belongs to, or the number of borders if the hole bounds the unbounded
/// region. `areas` are the doubled areas of the outer loops.
std::size_t find_owner(std::span<const Point> points, std::span<const VertexId> hole,
                       std::span<const SubdomainBorder> borders, std::span<const double> areas) {
    std::size_t owner = borders.size();
    for (std::size_t i = 0; i < borders.size(); ++i) {
        // Subdomains inside the hole have its vertices on their borders.
        const std::vector<VertexId>& outer = borders[i].loops.front();
        if (std::find(outer.begin(), outer.end(), hole.front()) == outer.end() &&
            is_inside(points, outer, points[hole.front().index()]) &&
            (owner == borders.size() || areas[i] < areas[owner]))
            owner = i;
    }
    return owner;
}

/// Finds ids in a sorted list. The vertices of a line have successive ids, so most are found beside the last one.
class LocalIds {
public:
    explicit LocalIds(std::span<const VertexId> ids) : ids_(ids) {}

    /// Returns the place of an id. Precondition: the list holds it.
    VertexId operator()(VertexId v) {
        if (last_ + 1 < ids_.size() && ids_[last_ + 1] == v)
            ++last_;
        else if (last_ > 0 && ids_[last_ - 1] == v)
            --last_;
        else
            last_ = static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), v) - ids_.begin());
        return VertexId{last_};
    }

private:
    std::span<const VertexId> ids_;
    std::size_t last_ = 0;
};

}  // namespace

LocalBorder localize(const SubdomainBorder& border, std::span<const Point> points) {
    LocalBorder local;
    std::vector<VertexId>& ids = local.global;
    for (const auto& loop : border.loops) ids.insert(ids.end(), loop.begin(), loop.end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    local.points.reserve(ids.size());
    for (const VertexId v : ids) local.points.push_back(points[v.index()]);
    std::size_t edges = 0;
    for (const auto& loop : border.loops) edges += loop.size();
    local.segments.reserve(edges);
    LocalIds local_id(ids);
    for (const auto& loop : border.loops) {
        const VertexId first = local_id(loop.front());
        VertexId a = first;
        for (std::size_t i = 1; i < loop.size(); ++i) {
            const VertexId b = local_id(loop[i]);
            local.segments.push_back({a, b});
            a = b;
        }
        local.segments.push_back({a, first});
    }
    return local;
}

std::vector<SubdomainBorder> trace_borders(std::span<const Point> points, std::span<const Segment> edges) {
    std::vector<SubdomainBorder> borders;
    std::vector<double> areas;
    std::vector<std::vector<VertexId>> holes;
    for (std::vector<VertexId>& loop : trace_loops(points, edges)) {
        if (const double area = doubled_area(points, loop); area > 0) {
            borders.push_back({{std::move(loop)}, false});
            areas.push_back(area);
        } else {
            holes.push_back(std::move(loop));
        }
    }
    // Subdomains do not overlap, so the outer loops round a hole are nested; the innermost one has the smallest area.
    for (std::vector<VertexId>& hole : holes) {
        const std::size_t owner = find_owner(points, hole, borders, areas);
        if (owner < borders.size()) borders[owner].loops.push_back(std::move(hole));
    }
    return borders;
}

BorderHalves split(const SubdomainBorder& border, std::size_t from, std::size_t to, std::span<const VertexId> line) {
    const std::vector<VertexId>& loop = border.loops.front();
    const auto append_range = [&](std::size_t first, std::size_t last, std::vector<VertexId>& part) {
        for (std::size_t i = first; i != last; i = i + 1 < loop.size() ? i + 1 : 0) part.push_back(loop[i]);
    };
    std::vector<VertexId> first{loop[from]}, second{loop[to]};
    first.insert(first.end(), line.begin(), line.end());
    append_range(to, from, first);
    second.insert(second.end(), line.rbegin(), line.rend());
    append_range(from, to, second);
    return {{{std::move(first)}, border.may_dangle}, {{std::move(second)}, border.may_dangle}};
}

SubdomainBorder join(const SubdomainBorder& border, LoopVertex from, LoopVertex to, std::span<const VertexId> line) {
    std::vector<VertexId> joined;
    const auto append_loop_from = [&](LoopVertex start) {
        const std::vector<VertexId>& loop = border.loops[start.loop];
        for (std::size_t k = 0; k <= loop.size(); ++k) joined.push_back(loop[(start.index + k) % loop.size()]);
    };
    append_loop_from(from);
    joined.insert(joined.end(), line.begin(), line.end());
    append_loop_from(to);
    joined.insert(joined.end(), line.rbegin(), line.rend());
    SubdomainBorder result = border;
    result.may_dangle = true;
    result.loops[std::min(from.loop, to.loop)] = std::move(joined);
    result.loops.erase(result.loops.begin() + static_cast<std::ptrdiff_t>(std::max(from.loop, to.loop)));
    return result;
}

}  // namespace lamina::decoupling
