// The points are lifted to the paraboloid that stands over the cut and projected along the direction across: the lower
// hull of what is seen is the silhouette of the paraboloid's lower hull, a path of Delaunay edges.
// Sources: G. E. Blelloch, G. L. Miller, J. C. Hardwick, D. Talmor, Design and implementation of a practical parallel
// Delaunay algorithm, Algorithmica 24 (1999); C. Kadow, PhD thesis, Carnegie Mellon (2004); J. K. Pardue, thesis
// (2015), 4.3; monotone chain: A. M. Andrew, Inf. Proc. Letters 9 (1979).
//
//        height                                   Only points near the cut can be on the hull. The few points nearest
//        to
//          |  o      o                            it, which stand side by side in the order across, make a rough chain.
//          |    o       o  o   o                  The hull lies below the chain, so a point counts only if it is no
//          |  *   o  *         *                  farther from the cut than the chain is high above the parabola over
//          |   \__*__/ \__*___/     along         the cut: which is a range of places in the order across.
//
// Ties: the height of every point is lowered infinitesimally, the smallest point's most.
#include "decomposition/dividing_path.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/predicates.hpp"

namespace lamina::decomposition {

namespace {

/// Points in a block of the order along the cut, which is looked at together.
constexpr std::size_t block = 64;

/// A cut with everything its path asks for, seen in its frame.
template <Axis axis>
class View {
public:
    View(const SortedPoints& sorted, const Subdomain& subdomain, std::size_t place)
        : points_(sorted.points.begin()),
          y_rank_(sorted.y_rank.begin()),
          across_((axis == Axis::x ? subdomain.by_x : subdomain.by_y).all()),
          along_((axis == Axis::x ? subdomain.by_y : subdomain.by_x).all()),
          place_(place),
          cut_((*this)(across_[place]).x) {}

    std::size_t size() const { return along_.size(); }
    double cut() const { return cut_; }
    std::size_t place() const { return place_; }
    Point operator()(Index i) const { return Frame{axis}(points_[i]); }
    /// The i-th point along the cut.
    Index along(std::size_t i) const { return axis == Axis::x ? along_[i] : along_[along_.size() - 1 - i]; }
    Index rank(Index i) const { return axis == Axis::x ? i : y_rank_[i]; }
    std::span<const Index> across() const { return across_; }

    struct Ranks {  // places in the order across
        Index first, last;
    };
    /// Ranks that hold those of all points at most so far from the cut.
    Ranks within(double distance) const {
        const double low = std::nextafter(cut_ - distance, -HUGE_VAL), high = std::nextafter(cut_ + distance, HUGE_VAL);
        const auto first =
            std::partition_point(across_.begin(), across_.end(), [&](Index i) { return (*this)(i).x < low; });
        const auto last = std::partition_point(first, across_.end(), [&](Index i) { return (*this)(i).x <= high; });
        // The cut's own point is always among them.
        return {rank(*first), rank(*(last - 1))};
    }

private:
    const Point* points_;
    const Index* y_rank_;
    std::span<const Index> across_, along_;
    std::size_t place_;
    double cut_;
};

/// A point of the rough chain.
struct Foot {
    double along, squared_distance;
    double height;  ///< of its image, relative to the cut's own point
};

template <Axis axis>
Foot foot(const View<axis>& view, Point p, double origin) {
    const double across = p.x - view.cut(), along = p.y - origin;
    return {p.y, across * across, across * across + along * along};
}

/// The points nearest to the cut, some of all along it, and the first and the last; in the order along the cut. Those
/// of all along it count where there are none near the cut, as beyond the outer border of a layer.
template <Axis axis>
std::vector<Foot> sample_feet(const View<axis>& view, double origin) {
    const auto before = [](const Foot& l, const Foot& r) { return l.along < r.along; };
    std::vector<Foot> near, spread, feet;
    const auto few = static_cast<std::size_t>(std::sqrt(static_cast<double>(view.size())));
    const std::size_t begin = view.place() - std::min(view.place(), few);
    const std::size_t end = std::min(view.size(), view.place() + few);
    for (const Index i : view.across().subspan(begin, end - begin)) near.push_back(foot(view, view(i), origin));
    std::sort(near.begin(), near.end(), before);
    for (std::size_t i = 0; i < view.size(); i += block) spread.push_back(foot(view, view(view.along(i)), origin));
    spread.push_back(foot(view, view(view.along(view.size() - 1)), origin));
    std::merge(near.begin(), near.end(), spread.begin(), spread.end(), std::back_inserter(feet), before);
    return feet;
}

/// Lower hull of the feet's images, by rounded arithmetic: between any two images the hull of all lies below.
void keep_lower_hull(std::vector<Foot>& feet) {
    std::size_t kept = 0;
    for (const Foot& foot : feet) {
        const auto above = [&](const Foot& a, const Foot& b) {
            return (b.along - a.along) * (foot.height - a.height) <= (foot.along - a.along) * (b.height - a.height);
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

/// May a point over this edge of the chain be below the chord? Nothing is lost to rounding: all terms are positive.
bool near_enough(const std::vector<Foot>& feet, std::size_t edge, Point p, double cut) {
    if (edge + 1 >= feet.size()) return true;
    const Foot &a = feet[edge], &b = feet[edge + 1];
    const double from_a = p.y - a.along, to_b = b.along - p.y, whole = b.along - a.along;
    if (!(from_a >= 0 && to_b >= 0 && whole > 0)) return true;
    constexpr double more_than_rounding = 1 + 0x1p-40;
    const double across = p.x - cut;
    return across * across * whole <=
           more_than_rounding * (to_b * a.squared_distance + from_a * b.squared_distance + from_a * to_b * whole);
}

/// The points that may be below the chain, along the cut.
template <Axis axis>
std::vector<Index> points_below(const View<axis> view, const std::vector<Foot>& chain) {
    using Ranks = typename View<axis>::Ranks;
    std::vector<Ranks> near;
    for (std::size_t e = 0; e + 1 < chain.size(); ++e) near.push_back(view.within(reach(chain[e], chain[e + 1])));
    if (near.empty()) near.push_back({0, std::numeric_limits<Index>::max()});

    std::vector<Index> result;
    std::size_t edge = 0;
    for (std::size_t begin = 0; begin < view.size(); begin += block) {
        const std::size_t end = std::min(begin + block, view.size());
        // Places near enough for any edge of the chain over the block.
        std::size_t edge_of_point = edge;
        Ranks ranks = near[edge];
        for (const double last = view(view.along(end - 1)).y;
             edge + 1 < near.size() && chain[edge + 1].along <= last;) {
            ++edge;
            ranks = {std::min(ranks.first, near[edge].first), std::max(ranks.last, near[edge].last)};
        }
        const Index first = ranks.first, range = ranks.last - ranks.first;
        for (std::size_t i = begin; i < end; ++i) {
            const Index candidate = view.along(i);
            if (view.rank(candidate) - first > range) continue;
            const Point p = view(candidate);
            while (edge_of_point < edge && chain[edge_of_point + 1].along < p.y) ++edge_of_point;
            if (near_enough(chain, edge_of_point, p, view.cut())) result.push_back(candidate);
        }
    }
    return result;
}

/// The points that may be on the path, along the cut.
template <Axis axis>
std::vector<Index> candidates(const View<axis>& view) {
    const double origin = view(view.across()[view.place()]).y;
    std::vector<Foot> chain = sample_feet(view, origin);
    keep_lower_hull(chain);
    return points_below(view, chain);
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

std::vector<Index> dividing_path(const SortedPoints& sorted, const Subdomain& points, Axis axis, std::size_t place) {
    return axis == Axis::x ? lower_hull(View<Axis::x>(sorted, points, place))
                           : lower_hull(View<Axis::y>(sorted, points, place));
}

}  // namespace lamina::decomposition
