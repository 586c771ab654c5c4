// The points are lifted to the paraboloid that stands over the cut and projected along the direction across: the lower
// hull of what is seen is the silhouette of the paraboloid's lower hull, a path of Delaunay edges.
// Sources: G. E. Blelloch, G. L. Miller, J. C. Hardwick, D. Talmor, Design and implementation of a practical parallel
// Delaunay algorithm, Algorithmica 24 (1999); C. Kadow, PhD thesis, Carnegie Mellon (2004); J. K. Pardue, thesis
// (2015), 4.3; monotone chain: A. M. Andrew, Inf. Proc. Letters 9 (1979).
//
//    height                            Only points near the cut can be on the hull. Some points near it and some of
//      |  o      o                     all along it make a rough chain. The hull lies below the chain, so a point
//      |    o       o  o   o           counts only if it is no farther from the cut than the chord over it is high
//      |  *   o  *         *           above the parabola over the cut. Under chords that reach few points these are
//      |   \__*__/ \__*___/            looked at in the order across the cut, under others in the order along it.
//      +---------------------- along
//
// Ties: the height of every point is lowered infinitesimally, the smallest point's most.
#include "delaunay/pieces/dividing_path.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/predicates.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// One of so many points along the cut helps to make the rough chain.
constexpr std::size_t points_per_foot = 64;

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
    std::span<const Index> across() const { return across_; }
    Index rank(Index i) const { return axis == Axis::x ? i : y_rank_[i]; }
    /// The i-th point along the cut.
    Index along(std::size_t i) const { return axis == Axis::x ? along_[i] : along_[along_.size() - 1 - i]; }
    bool comes_before(Index p, Index q) const { return axis == Axis::x ? y_rank_[p] < y_rank_[q] : p > q; }

    /// How many points have a lower coordinate along the cut.
    std::size_t count_below(double y) const {
        std::size_t low = 0, high = size();
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if ((*this)(along(middle)).y < y)
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    }
    /// All points at most so far from the cut, in the order across. The cut's own point is always among them.
    std::span<const Index> within(double distance) const {
        const double low = std::nextafter(cut_ - distance, -HUGE_VAL), high = std::nextafter(cut_ + distance, HUGE_VAL);
        const auto first =
            std::partition_point(across_.begin(), across_.end(), [&](Index i) { return (*this)(i).x < low; });
        const auto last = std::partition_point(first, across_.end(), [&](Index i) { return (*this)(i).x <= high; });
        return {first, last};
    }
    /// At most `count` points are nearer to the cut than this.
    double distance_of(std::size_t count) const {
        const std::size_t low = place_ - std::min(place_, count / 2), high = std::min(place_ + count / 2, size() - 1);
        return std::min(cut_ - (*this)(across_[low]).x, (*this)(across_[high]).x - cut_);
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

/// The points nearest to the cut, some of all along it, and the first and the last; in the order along the cut: at
/// least two. Those of all along it count where there are none near the cut, as beyond the outer border of a layer.
template <Axis axis>
std::vector<Foot> sample_feet(const View<axis>& view, double origin) {
    const auto before = [](const Foot& l, const Foot& r) { return l.along < r.along; };
    std::vector<Foot> near, spread, feet;
    const auto few = static_cast<std::size_t>(std::sqrt(static_cast<double>(view.size())));
    const std::size_t begin = view.place() - std::min(view.place(), few);
    const std::size_t end = std::min(view.size(), view.place() + few);
    for (const Index i : view.across().subspan(begin, end - begin)) near.push_back(foot(view, view(i), origin));
    std::sort(near.begin(), near.end(), before);
    for (std::size_t i = 0; i < view.size(); i += points_per_foot)
        spread.push_back(foot(view, view(view.along(i)), origin));
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

/// Between two successive feet of the chain.
struct Chord {
    Foot a, b;
    double reach;  ///< points under the chord that are farther than this from the cut are not on the hull
};

/// Above the parabola over the cut a chord is highest where both feet are as far away as the farther one.
std::vector<Chord> chords_of(const std::vector<Foot>& chain) {
    constexpr double more_than_rounding = 1 + 0x1p-40;
    std::vector<Chord> chords;
    chords.reserve(chain.size() - 1);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const Foot &a = chain[i], &b = chain[i + 1];
        const double half = 0.5 * (b.along - a.along);
        const double highest = std::max(a.squared_distance, b.squared_distance) + half * half;
        chords.push_back({a, b, more_than_rounding * std::sqrt(highest)});
    }
    return chords;
}

/// May a point under the chord be on the hull? Nothing is lost to rounding: all terms are positive.
bool near_enough(const Chord& chord, Point p, double cut) {
    const auto& [a, b, reach] = chord;
    const double from_a = p.y - a.along, to_b = b.along - p.y, whole = b.along - a.along;
    if (!(from_a >= 0 && to_b >= 0 && whole > 0)) return true;
    constexpr double more_than_rounding = 1 + 0x1p-40;
    const double across = p.x - cut;
    return across * across * whole <=
           more_than_rounding * (to_b * a.squared_distance + from_a * b.squared_distance + from_a * to_b * whole);
}

/// The points that may be on the hull under chords that reach less far than `few`.
template <Axis axis>
std::vector<Index> find_across(const View<axis>& view, const std::vector<Chord>& chords, double few) {
    double longest = -1;
    for (const Chord& chord : chords)
        if (chord.reach < few) longest = std::max(longest, chord.reach);
    if (longest < 0) return {};
    std::vector<Index> found;
    for (const Index i : view.within(longest)) {
        const Point p = view(i);
        const auto next = std::upper_bound(chords.begin() + 1, chords.end(), p.y,
                                           [](double y, const Chord& chord) { return y < chord.a.along; });
        const Chord& chord = *(next - 1);
        if (chord.reach < few && near_enough(chord, p, view.cut())) found.push_back(i);
    }
    std::sort(found.begin(), found.end(), [&](Index p, Index q) { return view.comes_before(p, q); });
    return found;
}

/// Those under the others.
template <Axis axis>
std::vector<Index> find_along(const View<axis>& view, const std::vector<Chord>& chords, double few) {
    std::vector<Index> found;
    for (const Chord& chord : chords) {
        if (chord.reach < few) continue;
        const bool first = &chord == &chords.front(), last = &chord == &chords.back();
        const std::size_t begin = first ? 0 : view.count_below(chord.a.along);
        const std::size_t end = last ? view.size() : view.count_below(chord.b.along);
        const std::span<const Index> within = view.within(chord.reach);
        const Index lowest = view.rank(within.front()), range = view.rank(within.back()) - lowest;
        for (std::size_t i = begin; i < end; ++i) {
            const Index point = view.along(i);
            if (view.rank(point) - lowest <= range && near_enough(chord, view(point), view.cut()))
                found.push_back(point);
        }
    }
    return found;
}

/// The points that may be on the path, along the cut. A point lies under the last chord that does not start behind it.
template <Axis axis>
std::vector<Index> candidates(const View<axis>& view) {
    const double origin = view(view.across()[view.place()]).y;
    std::vector<Foot> chain = sample_feet(view, origin);
    keep_lower_hull(chain);
    const std::vector<Chord> chords = chords_of(chain);
    // A point looked at in the order across costs as much as some ten in the order along.
    const double few = view.distance_of(view.size() / 32);
    const std::vector<Index> near = find_across(view, chords, few), far = find_along(view, chords, few);
    std::vector<Index> all(near.size() + far.size());
    std::merge(near.begin(), near.end(), far.begin(), far.end(), all.begin(),
               [&](Index p, Index q) { return view.comes_before(p, q); });
    return all;
}

/// Is p's image below that of q, which has the same coordinate along the cut?
template <Axis axis>
bool lower(const View<axis>& view, Index p, Index q) {
    const double at_p = view(p).x, at_q = view(q).x, cut = view.cut();
    if (at_p <= cut && at_q <= cut) return at_p > at_q;
    if (at_p >= cut && at_q >= cut) return at_p < at_q;
    // On two sides of the cut: the sign of (at_p - cut) + (at_q - cut), exactly, as a determinant.
    const double sum = core::inline_orient2d({at_p, -1}, {at_q, 1}, {cut, 0});
    if (sum != 0) return (at_p < cut) == (sum > 0);
    return p < q;
}

/// Is the image of b below the line through those of a and c?
template <Axis axis>
bool below(const View<axis>& view, Index a, Index b, Index c) {
    const double turn = core::flattened_turn(view(a), view(b), view(c), view.cut());
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

}  // namespace lamina::delaunay::pieces
