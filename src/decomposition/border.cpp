// Trimming of dividing paths: J. K. Pardue, thesis (2015), 6.7.
//
//          path                          Pieces of the path inside the region (+) become border of both parts, pieces
//            :   outside                 outside of it (:), beyond the outer border or through a body, of none. Which
//    --------o-----------                is which changes only at vertices of the border. A border edge belongs to the
//      low   +     high                  part on whose side of the path it lies; no edge may cross it.
//    --------o-----------
//            :   a body
#include "decomposition/border.hpp"

#include <algorithm>
#include <cstdint>

#include "core/predicates.hpp"

namespace lamina::decomposition {

namespace {

enum class Side { low, high, crossing };

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

/// A path, seen in the frame of its cut.
class Path {
public:
    Path(const SortedPoints& sorted, std::span<const Index> vertices, Cut cut)
        : sorted_(sorted), vertices_(vertices), cut_(cut), frame_{cut.axis} {
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            places_.push_back(std::uint64_t{vertices[i]} << 32 | i);
            extent_.include(point(vertices[i]));
        }
        std::sort(places_.begin(), places_.end());
    }

    Point point(Index i) const { return frame_(sorted_.points[i]); }
    std::span<const Index> vertices() const { return vertices_; }

    std::size_t place_of(Index i) const {
        const auto at = std::lower_bound(places_.begin(), places_.end(), std::uint64_t{i} << 32);
        return at != places_.end() && *at >> 32 == i ? *at & 0xffffffffu : nowhere;
    }

    /// Where an edge is that lies clear of the path's box in the direction across; most do.
    std::optional<Side> clear_side(Edge e) const {
        const double a = point(e.a).x, b = point(e.b).x;
        if (std::max(a, b) < extent_.lower.x) return Side::low;
        if (std::min(a, b) > extent_.upper.x) return Side::high;
        return {};
    }

    /// On which side of the path an edge lies that is none of it; the ends' places on it are given.
    Side side_of(Edge e, std::size_t place_a, std::size_t place_b) const {
        std::optional<Side> side;
        const auto agree = [&](Side s) {
            if (!side) side = s;
            return *side == s;
        };
        // Points off the path lie where the cut has them.
        if (place_a == nowhere) side = before_cut(e.a) ? Side::low : Side::high;
        if (place_b == nowhere && !agree(before_cut(e.b) ? Side::low : Side::high)) return Side::crossing;
        // All vertices of the path between the edge's ends have to be on the other side of the edge.
        Point a = point(e.a), b = point(e.b);
        if (a.y > b.y) std::swap(a, b);
        const auto first =
            std::partition_point(vertices_.begin(), vertices_.end(), [&](Index v) { return point(v).y <= a.y; });
        for (auto v = first; v != vertices_.end() && point(*v).y < b.y; ++v) {
            const double turn = detail::inline_orient2d(a, b, point(*v));
            if (turn == 0 || !agree(turn < 0 ? Side::low : Side::high)) return Side::crossing;
        }
        return side.value_or(Side::crossing);
    }

private:
    bool before_cut(Index i) const {
        return cut_.axis == Axis::x ? i < cut_.at : sorted_.y_rank[i] < sorted_.y_rank[cut_.at];
    }

    const SortedPoints& sorted_;
    std::span<const Index> vertices_;
    Cut cut_;
    Frame frame_;
    Box extent_;
    std::vector<std::uint64_t> places_;  ///< vertex above, place on the path below; sorted
};

/// An edge of the border that ends at a vertex of the path.
struct Spoke {
    std::size_t place;
    Index other;
    bool leaves;  ///< the border runs from the vertex to `other`: the region on the left, turning counter-clockwise
};

/// Turning clockwise round `center` from `from`: is x met before y? Directions of `from` itself come last.
bool met_before(Point center, Point from, Point x, Point y) {
    const auto half = [&](Point p) {
        const double turn = detail::inline_orient2d(center, from, p);
        if (turn != 0) return turn < 0 ? 0 : 2;
        return dot(from - center, p - center) < 0 ? 1 : 3;
    };
    const int half_x = half(x), half_y = half(y);
    return half_x != half_y ? half_x < half_y : detail::inline_orient2d(center, x, y) < 0;
}

/// Does the region lie in the direction of `to`, seen from a vertex of its border? `spokes` are all edges there.
bool leads_inside(const Path& path, Index vertex, Index to, std::span<const Spoke> spokes) {
    const Point center = path.point(vertex), from = path.point(to);
    const auto first = std::min_element(spokes.begin(), spokes.end(), [&](const Spoke& l, const Spoke& r) {
        return met_before(center, from, path.point(l.other), path.point(r.other));
    });
    return first->leaves;
}

}  // namespace

std::optional<DividedBorder> divide_border(const SortedPoints& sorted, std::span<const Edge> border,
                                           std::span<const Index> vertices, Cut cut) {
    const Path path(sorted, vertices, cut);
    DividedBorder result;
    result.low_has.assign(vertices.size(), 0);
    result.high_has.assign(vertices.size(), 0);
    std::vector<Spoke> spokes;
    std::vector<char> along_border(vertices.size(), 0);  // of the piece that starts at each vertex
    for (const Edge& e : border) {
        std::optional<Side> side = path.clear_side(e);
        std::size_t a = nowhere, b = nowhere;
        if (!side) {
            a = path.place_of(e.a);
            b = path.place_of(e.b);
            if (a != nowhere) spokes.push_back({a, e.b, true});
            if (b != nowhere) spokes.push_back({b, e.a, false});
            if (a != nowhere && b != nowhere && (a + 1 == b || b + 1 == a)) {
                along_border[std::min(a, b)] = 1;
                side = a < b ? Side::low : Side::high;
            } else {
                side = path.side_of(e, a, b);
            }
        }
        if (*side == Side::crossing) return {};
        (*side == Side::low ? result.low : result.high).push_back(e);
        std::vector<char>& has = *side == Side::low ? result.low_has : result.high_has;
        if (a != nowhere) has[a] = 1;
        if (b != nowhere) has[b] = 1;
    }
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& l, const Spoke& r) {
        return l.place != r.place ? l.place < r.place : l.other < r.other;
    });

    auto here = spokes.begin();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        auto next = here;
        while (next != spokes.end() && next->place == i) ++next;
        const std::span<const Spoke> at_vertex(here, next);
        here = next;
        if (i + 1 == vertices.size() || along_border[i]) continue;
        const bool inside = at_vertex.empty() || next == spokes.end() || next->place != i + 1 ||
                            leads_inside(path, vertices[i], vertices[i + 1], at_vertex);
        if (!inside) continue;
        result.low.push_back({vertices[i], vertices[i + 1]});
        result.high.push_back({vertices[i + 1], vertices[i]});
        for (std::size_t end : {i, i + 1}) result.low_has[end] = result.high_has[end] = 1;
    }
    return result;
}

std::vector<Edge> convex_hull(const SortedPoints& sorted) {
    const std::span<const Point> points = sorted.points;
    const std::size_t n = points.size();
    std::vector<Index> hull;
    const auto add_chain = [&](auto&& point_at) {
        const std::size_t start = hull.size();
        for (std::size_t k = 0; k < n; ++k) {
            const Index c = point_at(k);
            while (hull.size() >= start + 2 &&
                   detail::inline_orient2d(points[hull[hull.size() - 2]], points[hull.back()], points[c]) < 0)
                hull.pop_back();
            hull.push_back(c);
        }
        hull.pop_back();
    };
    add_chain([](std::size_t k) { return static_cast<Index>(k); });
    const std::size_t lower = hull.size();
    add_chain([n](std::size_t k) { return static_cast<Index>(n - 1 - k); });
    if (lower + 1 == n && hull.size() - lower + 1 == n) return {};
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < hull.size(); ++i) edges.push_back({hull[i], hull[i + 1 < hull.size() ? i + 1 : 0]});
    return edges;
}

}  // namespace lamina::decomposition
