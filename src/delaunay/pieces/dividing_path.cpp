// The points are lifted to the paraboloid that stands over the cut line and projected along the direction across the
// line. The lower hull of these images is the silhouette of the lower hull of the lifted points: a path of Delaunay
// edges.
// Sources: G. E. Blelloch, G. L. Miller, J. C. Hardwick, D. Talmor, Design and implementation of a practical parallel
// Delaunay algorithm, Algorithmica 24 (1999); C. Kadow, PhD thesis, Carnegie Mellon (2004); J. K. Pardue, thesis
// (2015), 4.3; monotone chain: A. M. Andrew, Inf. Proc. Letters 9 (1979).
//
//    height of the image             Only points near the cut line can be on the hull. A sample of the points (*),
//      |  o      o                   some nearest to the line and some all along it, makes a chain that bounds the
//      |    o       o  o   o         hull from above. The image of a point lies above the parabola over the line by
//      |  *   o  *         *         the square of the point's distance from the line. The point can be on the hull
//      |   \__*__/ \__*___/          only if this is no more than the chord over it does: each chord has a reach.
//      +-------------------- along
//
// Points under chords that reach few points are looked at in the order across the line, points under the other chords
// in the order along it.
//
// Ties: the height of every image is lowered infinitesimally, that of the smallest point most.
#include "delaunay/pieces/dividing_path.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "core/predicates.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// Of this many points along the cut one belongs to the sample.
constexpr std::size_t points_per_sample = 64;

/// Makes upper bounds large enough in spite of rounding.
constexpr double more_than_rounding = 1 + 0x1p-40;

/// The points of a piece in the frame of a cut.
template <Axis axis>
class CutView {
public:
    CutView(const SortedPoints& sorted, const Piece& piece, std::size_t place)
        : points_(sorted.points.begin()),
          y_rank_(sorted.y_rank.begin()),
          across_((axis == Axis::x ? piece.by_x : piece.by_y).all()),
          along_((axis == Axis::x ? piece.by_y : piece.by_x).all()),
          place_(place),
          cut_((*this)(across_[place]).x) {}

    std::size_t size() const { return along_.size(); }
    /// Returns the coordinate of the cut line across itself.
    double cut() const { return cut_; }
    /// Returns the place of the cut in the order across.
    std::size_t place() const { return place_; }
    /// Returns a point in the frame.
    Point operator()(Index i) const { return CutFrame{axis}(points_[i]); }

    /// Returns the points in the order across the cut line.
    std::span<const Index> across() const { return across_; }
    /// Returns the rank of a point, among all points, in the order across.
    Index rank(Index i) const { return axis == Axis::x ? i : y_rank_[i]; }
    /// Returns the i-th point in the order along the cut line.
    Index along(std::size_t i) const { return axis == Axis::x ? along_[i] : along_[along_.size() - 1 - i]; }
    /// Returns whether p comes before q in the order along the cut line.
    bool comes_before(Index p, Index q) const { return axis == Axis::x ? y_rank_[p] < y_rank_[q] : p > q; }

    /// Returns the number of points that have a lower coordinate than y along the cut line.
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

    /// Returns all points at most this far from the cut line, in the order across. The cut's own point is always among
    /// them.
    std::span<const Index> within(double distance) const {
        const double low = std::nextafter(cut_ - distance, -HUGE_VAL), high = std::nextafter(cut_ + distance, HUGE_VAL);
        const auto first =
            std::partition_point(across_.begin(), across_.end(), [&](Index i) { return (*this)(i).x < low; });
        const auto last = std::partition_point(first, across_.end(), [&](Index i) { return (*this)(i).x <= high; });
        return {first, last};
    }

    /// Returns a distance from the cut line; at most `count` points are nearer to the line.
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

/// A point of the sample.
struct Sample {
    double along;             ///< coordinate along the cut line
    double squared_distance;  ///< from the cut line
    double height;            ///< of the image, above that of the cut's own point
};

/// Makes a sample of the point p of the frame. `origin` is the coordinate of the cut's own point along the line.
template <Axis axis>
Sample sample_at(const CutView<axis>& view, Point p, double origin) {
    const double across = p.x - view.cut(), along = p.y - origin;
    return {p.y, across * across, across * across + along * along};
}

/// Returns the points nearest to the cut line, some points all along it, and the first and the last one: two samples or
/// more, in the order along the line. The samples all along the line count where no point is near it, for instance
/// beyond the outer border of a layer.
template <Axis axis>
std::vector<Sample> take_samples(const CutView<axis>& view, double origin) {
    const auto before = [](const Sample& l, const Sample& r) { return l.along < r.along; };
    std::vector<Sample> near, spread, samples;
    const auto near_count = static_cast<std::size_t>(std::sqrt(static_cast<double>(view.size())));
    const std::size_t begin = view.place() - std::min(view.place(), near_count);
    const std::size_t end = std::min(view.size(), view.place() + near_count);
    for (const Index i : view.across().subspan(begin, end - begin)) near.push_back(sample_at(view, view(i), origin));
    std::sort(near.begin(), near.end(), before);
    for (std::size_t i = 0; i < view.size(); i += points_per_sample)
        spread.push_back(sample_at(view, view(view.along(i)), origin));
    spread.push_back(sample_at(view, view(view.along(view.size() - 1)), origin));
    std::merge(near.begin(), near.end(), spread.begin(), spread.end(), std::back_inserter(samples), before);
    return samples;
}

/// Reduces samples to the lower hull of their images. Arithmetic may be rounded, because the hull of all points lies
/// below the chord between any two of the images.
void keep_lower_hull(std::vector<Sample>& samples) {
    std::size_t kept = 0;
    for (const Sample& sample : samples) {
        const auto above = [&](const Sample& a, const Sample& b) {
            return (b.along - a.along) * (sample.height - a.height) <= (sample.along - a.along) * (b.height - a.height);
        };
        while (kept >= 2 && above(samples[kept - 2], samples[kept - 1])) --kept;
        samples[kept++] = sample;
    }
    samples.resize(kept);
}

/// The chord between two successive samples of the chain.
struct Chord {
    Sample a, b;
    double reach;  ///< points under the chord that are farther than this from the cut line are not on the hull
};

/// Returns the chords of a chain with their reaches. The height of a chord above the parabola over the cut line is
/// largest where both its samples are as far from the line as the farther one.
std::vector<Chord> make_chords(const std::vector<Sample>& chain) {
    std::vector<Chord> chords;
    chords.reserve(chain.size() - 1);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const Sample &a = chain[i], &b = chain[i + 1];
        const double half = 0.5 * (b.along - a.along);
        const double highest = std::max(a.squared_distance, b.squared_distance) + half * half;
        chords.push_back({a, b, more_than_rounding * std::sqrt(highest)});
    }
    return chords;
}

/// Returns whether a point under the chord may be on the hull. Rounding loses no point: all terms are positive.
bool may_be_on_hull(const Chord& chord, Point p, double cut) {
    const auto& [a, b, reach] = chord;
    const double from_a = p.y - a.along, to_b = b.along - p.y, whole = b.along - a.along;
    if (!(from_a >= 0 && to_b >= 0 && whole > 0)) return true;
    const double across = p.x - cut;
    return across * across * whole <=
           more_than_rounding * (to_b * a.squared_distance + from_a * b.squared_distance + from_a * to_b * whole);
}

/// Returns the points that may be on the hull under chords that reach less far than `short_reach`, in the order along
/// the line. It looks at them in the order across, where they stand side by side.
template <Axis axis>
std::vector<Index> candidates_under_short_reaches(const CutView<axis>& view, const std::vector<Chord>& chords,
                                                  double short_reach) {
    double longest = -1;
    for (const Chord& chord : chords)
        if (chord.reach < short_reach) longest = std::max(longest, chord.reach);
    if (longest < 0) return {};
    std::vector<Index> found;
    for (const Index i : view.within(longest)) {
        const Point p = view(i);
        // A point lies under the last chord that does not begin behind it.
        const auto next = std::upper_bound(chords.begin() + 1, chords.end(), p.y,
                                           [](double y, const Chord& chord) { return y < chord.a.along; });
        const Chord& chord = *(next - 1);
        if (chord.reach < short_reach && may_be_on_hull(chord, p, view.cut())) found.push_back(i);
    }
    std::sort(found.begin(), found.end(), [&](Index p, Index q) { return view.comes_before(p, q); });
    return found;
}

/// Returns the points that may be on the hull under all other chords, in the order along the line. It looks at them in
/// this order.
template <Axis axis>
std::vector<Index> candidates_under_long_reaches(const CutView<axis>& view, const std::vector<Chord>& chords,
                                                 double short_reach) {
    std::vector<Index> found;
    for (const Chord& chord : chords) {
        if (chord.reach < short_reach) continue;
        const bool first = &chord == &chords.front(), last = &chord == &chords.back();
        const std::size_t begin = first ? 0 : view.count_below(chord.a.along);
        const std::size_t end = last ? view.size() : view.count_below(chord.b.along);
        const std::span<const Index> within = view.within(chord.reach);
        const Index lowest = view.rank(within.front()), range = view.rank(within.back()) - lowest;
        for (std::size_t i = begin; i < end; ++i) {
            const Index point = view.along(i);
            if (view.rank(point) - lowest <= range && may_be_on_hull(chord, view(point), view.cut()))
                found.push_back(point);
        }
    }
    return found;
}

/// Returns the points that may be on the path, in the order along the cut line.
template <Axis axis>
std::vector<Index> path_candidates(const CutView<axis>& view) {
    const double origin = view(view.across()[view.place()]).y;
    std::vector<Sample> chain = take_samples(view, origin);
    keep_lower_hull(chain);
    const std::vector<Chord> chords = make_chords(chain);
    // To look at a point in the order across costs as much as to look at some ten points in the order along the line.
    const double short_reach = view.distance_of(view.size() / 32);
    const std::vector<Index> near = candidates_under_short_reaches(view, chords, short_reach),
                             far = candidates_under_long_reaches(view, chords, short_reach);
    std::vector<Index> all(near.size() + far.size());
    std::merge(near.begin(), near.end(), far.begin(), far.end(), all.begin(),
               [&](Index p, Index q) { return view.comes_before(p, q); });
    return all;
}

/// Returns whether the image of p is lower than the image of q. Precondition: p and q have the same coordinate along
/// the cut line.
template <Axis axis>
bool is_lower(const CutView<axis>& view, Index p, Index q) {
    const double at_p = view(p).x, at_q = view(q).x, cut = view.cut();
    if (at_p <= cut && at_q <= cut) return at_p > at_q;
    if (at_p >= cut && at_q >= cut) return at_p < at_q;
    // They lie on two sides of the cut line: the determinant has the sign of (at_p - cut) + (at_q - cut), exactly.
    const double sum = core::inline_orient2d({at_p, -1}, {at_q, 1}, {cut, 0});
    if (sum != 0) return (at_p < cut) == (sum > 0);
    return p < q;
}

/// Returns whether the image of b lies below the line through the images of a and c.
template <Axis axis>
bool is_below_line(const CutView<axis>& view, Index a, Index b, Index c) {
    const double turn = core::flattened_turn(view(a), view(b), view(c), view.cut());
    return turn != 0 ? turn > 0 : b < std::min(a, c);
}

template <Axis axis>
std::vector<Index> lower_hull(const CutView<axis>& view) {
    std::vector<Index> hull;
    for (const Index c : path_candidates(view)) {
        if (!hull.empty() && view(hull.back()).y == view(c).y) {
            if (!is_lower(view, c, hull.back())) continue;
            hull.pop_back();
        }
        while (hull.size() >= 2 && !is_below_line(view, hull[hull.size() - 2], hull.back(), c)) hull.pop_back();
        hull.push_back(c);
    }
    return hull;
}

}  // namespace

std::vector<Index> dividing_path(const SortedPoints& sorted, const Piece& piece, Axis axis, std::size_t place) {
    return axis == Axis::x ? lower_hull(CutView<Axis::x>(sorted, piece, place))
                           : lower_hull(CutView<Axis::y>(sorted, piece, place));
}

}  // namespace lamina::delaunay::pieces
