// The points are lifted to the paraboloid that stands over the cut and projected along the direction across: the lower
// hull of what is seen is the silhouette of the paraboloid's lower hull, a path of Delaunay edges.
// Sources: G. E. Blelloch, G. L. Miller, J. C. Hardwick, D. Talmor, Design and implementation of a practical parallel
// Delaunay algorithm, Algorithmica 24 (1999); C. Kadow, PhD thesis, Carnegie Mellon (2004); J. K. Pardue, thesis
// (2015), 4.3; monotone chain: A. M. Andrew, Inf. Proc. Letters 9 (1979).
//
//        height                                   Only points near the cut can be on the hull. One point of each block
//          |  o      o                            of the order along the cut, the one nearest to it, makes a rough
//          |    o       o  o   o                  chain. The hull lies below the chain, so a point counts only if it
//          |  *   o  *         *                  is no farther from the cut than the chain is high above the parabola
//          |   \__*__/ \__*___/     along         under it: for most blocks that is known from their nearest point.
//
// Ties: the height of every point is lowered infinitesimally, the smallest point's most.
#include "decomposition/dividing_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/predicates.hpp"

namespace lamina::decomposition {

namespace {

/// Points in a block of the order along the cut.
constexpr std::size_t block = 64;

/// A cut with everything its path asks for, seen in its frame.
template <Axis axis>
class View {
public:
    View(const SortedPoints& sorted, const Subdomain& subdomain, Index at)
        : sorted_(sorted), subdomain_(subdomain), cut_((*this)(at).x), rank_(rank(at)) {}

    std::size_t size() const { return subdomain_.size(); }
    double cut() const { return cut_; }
    Point operator()(Index i) const { return Frame{axis}(sorted_.points[i]); }
    /// The i-th point along the cut.
    Index along(std::size_t i) const {
        return axis == Axis::x ? subdomain_.by_y[i] : subdomain_.by_x[subdomain_.size() - 1 - i];
    }
    Index rank_of_cut() const { return rank_; }
    Index rank(Index i) const { return axis == Axis::x ? i : sorted_.y_rank[i]; }
    /// Places between a point and the cut in the order across: for points on one side a measure of distance.
    Index places_away(Index i) const {
        const Index r = rank(i);
        return r < rank_ ? rank_ - r : r - rank_;
    }

    struct Ranks {
        Index first, last;
        bool contains(Index r) const { return r - first <= last - first; }
    };
    /// Ranks that hold those of all points at most so far from the cut.
    Ranks within(double distance) const {
        const std::span<const Index> across = (axis == Axis::x ? subdomain_.by_x : subdomain_.by_y).all();
        const double low = std::nextafter(cut_ - distance, -HUGE_VAL), high = std::nextafter(cut_ + distance, HUGE_VAL);
        const auto first =
            std::partition_point(across.begin(), across.end(), [&](Index i) { return (*this)(i).x < low; });
        const auto last = std::partition_point(first, across.end(), [&](Index i) { return (*this)(i).x <= high; });
        // The cut's own point is always among them.
        return {rank(*first), rank(*(last - 1))};
    }

private:
    const SortedPoints& sorted_;
    const Subdomain& subdomain_;
    double cut_;
    Index rank_;
};

/// A point of the rough chain.
struct Foot {
    double along, squared_distance;
};

/// The point nearest to the cut in each block, and the first and the last point along the cut.
template <Axis axis>
std::vector<Foot> rough_chain(const View<axis>& view, std::vector<Index>& nearest_places) {
    std::vector<Foot> feet;
    const auto add = [&](Index i) {
        const Point p = view(i);
        const double distance = p.x - view.cut();
        feet.push_back({p.y, distance * distance});
    };
    add(view.along(0));
    for (std::size_t begin = 0; begin < view.size(); begin += block) {
        const std::size_t end = std::min(begin + block, view.size());
        Index nearest = view.along(begin), places = view.places_away(nearest);
        for (std::size_t i = begin + 1; i < end; ++i) {
            const Index candidate = view.along(i), away = view.places_away(candidate);
            if (away < places) {
                places = away;
                nearest = candidate;
            }
        }
        nearest_places.push_back(places);
        add(nearest);
    }
    add(view.along(view.size() - 1));
    return feet;
}

/// Lower hull of the feet's images, by rounded arithmetic: between any two images the hull of all lies below.
void keep_lower_hull(std::vector<Foot>& feet) {
    const double origin = feet[feet.size() / 2].along;
    const auto height = [&](const Foot& f) { return f.squared_distance + (f.along - origin) * (f.along - origin); };
    std::size_t kept = 0;
    for (const Foot& foot : feet) {
        const auto above = [&](const Foot& a, const Foot& b) {
            return (b.along - a.along) * (height(foot) - height(a)) <= (foot.along - a.along) * (height(b) - height(a));
        };
        while (kept >= 2 && above(feet[kept - 2], feet[kept - 1])) --kept;
        feet[kept++] = foot;
    }
    feet.resize(kept);
}

/// Farther than this from the cut no point between the two feet is on the hull: the chord minus the parabola over the
/// cut is largest between the feet where both are as far away as the farther one.
double reach(const Foot& a, const Foot& b) {
    const double half = 0.5 * (b.along - a.along);
    constexpr double more_than_rounding = 1 + 0x1p-40;
    return more_than_rounding * std::sqrt(std::max(a.squared_distance, b.squared_distance) + half * half);
}

/// The points that may be on the path, along the cut.
template <Axis axis>
std::vector<Index> candidates(const View<axis>& view) {
    std::vector<Index> nearest_places;
    std::vector<Foot> feet = rough_chain(view, nearest_places);
    keep_lower_hull(feet);
    std::vector<typename View<axis>::Ranks> near;
    for (std::size_t e = 0; e + 1 < feet.size(); ++e) near.push_back(view.within(reach(feet[e], feet[e + 1])));
    if (near.empty()) near.push_back({0, std::numeric_limits<Index>::max()});

    std::vector<Index> result;
    std::size_t edge = 0;
    for (std::size_t begin = 0; begin < view.size(); begin += block) {
        const std::size_t end = std::min(begin + block, view.size());
        const double last = view(view.along(end - 1)).y;
        // Ranks near enough for any edge over the block.
        typename View<axis>::Ranks ranks = near[edge];
        while (edge + 1 < near.size() && feet[edge + 1].along <= last) {
            ++edge;
            ranks = {std::min(ranks.first, near[edge].first), std::max(ranks.last, near[edge].last)};
        }
        const Index center = view.rank_of_cut();
        if (nearest_places[begin / block] > std::max(center - ranks.first, ranks.last - center)) continue;
        for (std::size_t i = begin; i < end; ++i) {
            const Index candidate = view.along(i);
            if (ranks.contains(view.rank(candidate))) result.push_back(candidate);
        }
    }
    return result;
}

/// Is p's image below that of q, which has the same coordinate along the cut?
template <Axis axis>
bool lower(const View<axis>& view, Index p, Index q) {
    const double at_p = view(p).x, at_q = view(q).x, cut = view.cut();
    if (at_p <= cut && at_q <= cut) return at_p > at_q;
    if (at_p >= cut && at_q >= cut) return at_p < at_q;
    // On two sides of the cut: the sign of (at_p - cut) + (at_q - cut), exactly, as a determinant.
    const double sum = detail::inline_orient2d({at_p, -1}, {at_q, 1}, {cut, 0});
    if (sum != 0) return (at_p < cut) == (sum > 0);
    return p < q;
}

/// Is the image of b below the line through those of a and c?
template <Axis axis>
bool below(const View<axis>& view, Index a, Index b, Index c) {
    const double turn = detail::flattened_turn(view(a), view(b), view(c), view.cut());
    return turn != 0 ? turn > 0 : b < std::min(a, c);
}

template <Axis axis>
std::vector<Index> lower_hull(const View<axis>& view) {
    std::vector<Index> hull;
    for (const Index c : candidates(view)) {
        if (!hull.empty() && view(hull.back()).y == view(c).y) {
            if (!lower(view, c, hull.back())) continue;
            hull.pop_back();
        }
        while (hull.size() >= 2 && !below(view, hull[hull.size() - 2], hull.back(), c)) hull.pop_back();
        hull.push_back(c);
    }
    return hull;
}

}  // namespace

std::vector<Index> dividing_path(const SortedPoints& sorted, const Subdomain& points, Cut cut) {
    return cut.axis == Axis::x ? lower_hull(View<Axis::x>(sorted, points, cut.at))
                               : lower_hull(View<Axis::y>(sorted, points, cut.at));
}

}  // namespace lamina::decomposition
