// Trimming of dividing paths: J. K. Pardue, thesis (2015), 6.7.
//
//          path                          Pieces of the path inside the region (+) become border of both parts, pieces
//            :   outside                 outside of it (:), beyond the outer border or through a body, of none. Which
//    --------o-----------                is which changes only at vertices of the border. A border edge belongs to the
//      low   +     high                  part on whose side of the path it lies; no edge may cross it.
//    --------o-----------
//            :   a body
#include "delaunay/pieces/border.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "core/predicates.hpp"
#include "delaunay/pieces/places.hpp"

namespace lamina::delaunay::pieces {

namespace {

enum class Side { low, high, crossing };

/// A path, seen in the frame of its cut.
class Path {
public:
    Path(const SortedPoints& sorted, std::span<const Index> vertices, Cut cut)
        : sorted_(sorted), cut_(cut), frame_{cut.axis}, places_(vertices) {
        for (const Index v : vertices) {
            points_.push_back(point(v));
            extent_.include(points_.back());
        }
    }

    Point point(Index i) const { return frame_(sorted_.points[i]); }
    std::size_t place_of(Index i) const { return places_.of(i); }

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
        const auto first = std::partition_point(points_.begin(), points_.end(), [&](Point p) { return p.y <= a.y; });
        for (auto p = first; p != points_.end() && p->y < b.y; ++p) {
            const double turn = core::inline_orient2d(a, b, *p);
            if (turn == 0 || !agree(turn < 0 ? Side::low : Side::high)) return Side::crossing;
        }
        return side.value_or(Side::crossing);
    }

private:
    bool before_cut(Index i) const {
        return cut_.axis == Axis::x ? i < cut_.at : sorted_.y_rank[i] < sorted_.y_rank[cut_.at];
    }

    const SortedPoints& sorted_;
    Cut cut_;
    Frame frame_;
    Box extent_;
    std::vector<Point> points_;
    Places places_;
};

/// An edge of the border that ends at a vertex of the path.
struct Spoke {
    std::size_t place;
    Index other;
    bool leaves;  ///< the border runs from the vertex to `other`: the region on the left, turning counter-clockwise
};

std::vector<Spoke> by_place(const std::vector<Spoke>& spokes, std::size_t places) {
    std::vector<std::size_t> starts(places + 1, 0);
    for (const Spoke& s : spokes) ++starts[s.place + 1];
    for (std::size_t p = 1; p < starts.size(); ++p) starts[p] += starts[p - 1];
    std::vector<Spoke> sorted(spokes.size());
    for (const Spoke& s : spokes) sorted[starts[s.place]++] = s;
    return sorted;
}

/// Turning clockwise round `center` from `from`: is x met before y? Directions of `from` itself come last.
bool met_before(Point center, Point from, Point x, Point y) {
    const auto half = [&](Point p) {
        const double turn = core::inline_orient2d(center, from, p);
        if (turn != 0) return turn < 0 ? 0 : 2;
        return dot(from - center, p - center) < 0 ? 1 : 3;
    };
    const int half_x = half(x), half_y = half(y);
    return half_x != half_y ? half_x < half_y : core::inline_orient2d(center, x, y) < 0;
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
    const std::vector<Spoke> sorted_spokes = by_place(spokes, vertices.size());

    auto here = sorted_spokes.begin();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        auto next = here;
        while (next != sorted_spokes.end() && next->place == i) ++next;
        const std::span<const Spoke> at_vertex(here, next);
        here = next;
        if (i + 1 == vertices.size() || along_border[i]) continue;
        const bool inside = at_vertex.empty() || next == sorted_spokes.end() || next->place != i + 1 ||
                            leads_inside(path, vertices[i], vertices[i + 1], at_vertex);
        if (!inside) continue;
        result.low.push_back({vertices[i], vertices[i + 1]});
        result.high.push_back({vertices[i + 1], vertices[i]});
        for (std::size_t end : {i, i + 1}) result.low_has[end] = result.high_has[end] = 1;
    }
    return result;
}

namespace {

/// Points in the order by x are looked at in blocks.
constexpr std::size_t block = 64;

/// The lowest and the highest point of every block.
struct Outermost {
    std::vector<Point> lowest, highest;
};

Outermost outermost_of_blocks(std::span<const Point> points) {
    Outermost outermost;
    const std::size_t blocks = (points.size() + block - 1) / block;
    outermost.lowest.resize(blocks);
    outermost.highest.resize(blocks);
    core::parallel_for(blocks, 2000, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const std::span<const Point> own = points.subspan(b * block, std::min(block, points.size() - b * block));
            const Point *lowest = own.data(), *highest = own.data();
            for (const Point& p : own) {
                if (p.y < lowest->y) lowest = &p;
                if (p.y > highest->y) highest = &p;
            }
            outermost.lowest[b] = *lowest;
            outermost.highest[b] = *highest;
        }
    });
    return outermost;
}

/// The points that may be on the lower side (sign 1) or the upper side (-1) of the hull, in ascending order: those on
/// or beyond the chords between the outermost points of blocks.
template <int sign>
std::vector<Index> hull_candidates(std::span<const Point> points, std::span<const Point> outermost) {
    // Towards the outside counts as low.
    const auto height = [](Point p) { return sign * p.y; };
    // Rounded: chords between points lie above the hull, whichever they are.
    double magnitude = 0;
    const double end_x = points.back().x;
    std::vector<Point> chain;
    for (const Point o : outermost) {
        const Point p{o.x, height(o)};
        magnitude = std::max(magnitude, std::abs(p.y));
        while (chain.size() >= 2 && cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0)
            chain.pop_back();
        if (chain.empty() || p.x > chain.back().x) chain.push_back(p);
    }
    std::size_t edge = 0;
    const auto chord = [&](double x) {
        while (edge + 2 < chain.size() && chain[edge + 1].x < x) ++edge;
        const bool beyond = chain.size() < 2 || x < chain[edge].x || x > chain[edge + 1].x;
        if (beyond) return HUGE_VAL;
        const Point a = chain[edge], b = chain[edge + 1];
        return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    };
    std::vector<Index> result;
    double at_begin = HUGE_VAL;
    for (std::size_t begin = 0; begin < points.size(); begin += block) {
        const std::size_t end = std::min(begin + block, points.size());
        const double at_end = points[end - 1].x < end_x ? chord(points[end - 1].x) : HUGE_VAL;
        const double highest = std::max(at_begin, at_end) + 0x1p-40 * magnitude;
        at_begin = at_end;
        if (height(outermost[begin / block]) > highest) continue;
        for (std::size_t i = begin; i < end; ++i)
            if (height(points[i]) <= highest) result.push_back(static_cast<Index>(i));
    }
    return result;
}

}  // namespace

std::vector<Edge> convex_hull(const SortedPoints& sorted) {
    const std::span<const Point> points = sorted.points.all();
    std::vector<Index> hull;
    // Collinear points stay. The last one of a chain is the first one of the other.
    const auto add_chain = [&](const std::vector<Index>& candidates) {
        const std::size_t start = hull.size();
        for (const Index c : candidates) {
            while (hull.size() >= start + 2 &&
                   core::inline_orient2d(points[hull[hull.size() - 2]], points[hull.back()], points[c]) < 0)
                hull.pop_back();
            hull.push_back(c);
        }
        hull.pop_back();
        return hull.size() - start;
    };
    const Outermost outermost = outermost_of_blocks(points);
    const std::size_t lower = add_chain(hull_candidates<1>(points, outermost.lowest));
    std::vector<Index> upper_candidates = hull_candidates<-1>(points, outermost.highest);
    std::reverse(upper_candidates.begin(), upper_candidates.end());
    const std::size_t upper = add_chain(upper_candidates);
    if (lower + 1 == points.size() && upper + 1 == points.size()) return {};
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < hull.size(); ++i) edges.push_back({hull[i], hull[i + 1 < hull.size() ? i + 1 : 0]});
    return edges;
}

}  // namespace lamina::delaunay::pieces
