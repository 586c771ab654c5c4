#include "geometry/folds.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace lamina::geometry {

namespace {

using SourcePoints = std::vector<SourcePoint>;

constexpr double cos_40_deg = 0.76604444311897804, cos_30_deg = 0.86602540378443865, cos_15_deg = 0.96592582628906829;

/// The turn of a polyline at one of its points.
struct Turn {
    double cosine = 1, sine = 0;

    bool is_smooth() const { return cosine > cos_30_deg; }
    bool is_corner() const { return cosine < 0.5; }
    bool reverses(double min_cosine) const { return cosine < -min_cosine; }
    bool opposes(const Turn& other) const { return sine * other.sine < 0; }
};

Turn turn_at(Point a, Point b, Point c) {
    const Point in = b - a, out = c - b;
    const double lengths = std::sqrt(squared_length(in)) * std::sqrt(squared_length(out));
    return lengths > 0 ? Turn{dot(in, out) / lengths, cross(in, out) / lengths} : Turn{};
}

/// The points of an outline, counted round it.
class Loop {
public:
    explicit Loop(const SourcePoints& points) : points_(points) {}

    const SourcePoint& operator[](std::size_t i) const { return points_[i % points_.size()]; }
    std::size_t before(std::size_t i, std::size_t steps) const { return (i + points_.size() - steps) % points_.size(); }
    Turn turn(std::size_t i) const { return turn_at((*this)[before(i, 1)].at, (*this)[i].at, (*this)[i + 1].at); }

private:
    const SourcePoints& points_;
};

/// Six points in a row, the two turning points in the middle of them.
using Stretch = std::array<Point, 6>;

/// Returns how much a stretch bends at its inner points, in radians where that is little; nothing where it is not
/// smooth there. It may keep a corner at its second point or its last but one, where it had one that turned the same
/// way, as far as that can be said.
std::optional<double> bending(const std::vector<Point>& stretch, const Turn& corner_before, const Turn& corner_behind) {
    const auto keeps = [](const Turn& before, const Turn& now) {
        return before.is_corner() && now.is_corner() && (before.reverses(cos_15_deg) || !before.opposes(now));
    };
    double sum = 0;
    for (std::size_t i = 1; i + 1 < stretch.size(); ++i) {
        const Turn turn = turn_at(stretch[i - 1], stretch[i], stretch[i + 1]);
        if ((i == 1 && keeps(corner_before, turn)) || (i + 2 == stretch.size() && keeps(corner_behind, turn))) continue;
        if (!turn.is_smooth()) return std::nullopt;
        sum += std::abs(turn.sine);
    }
    return sum;
}

/// The ways to mend a fold, each with what bending() says of it.
struct FoldRepairs {
    std::optional<double> without_first, without_second, exchanged;
};

FoldRepairs possible_repairs(const Stretch& s) {
    const Turn before = turn_at(s[0], s[1], s[2]), behind = turn_at(s[3], s[4], s[5]);
    return {bending({s[0], s[1], s[3], s[4], s[5]}, before, behind),
            bending({s[0], s[1], s[2], s[4], s[5]}, before, behind),
            bending({s[0], s[1], s[3], s[2], s[4], s[5]}, before, behind)};
}

/// Mends the fold between point i and the next one, and returns how.
FoldMend mend_between(SourcePoints& points, std::size_t i, bool closed, std::size_t& left_out) {
    constexpr double most_bending_ratio = 1.5, most_further_bending = 0.05;
    const Loop loop(points);
    const std::size_t n = points.size(), next = (i + 1) % n;
    Stretch stretch;
    for (std::size_t k = 0; k < stretch.size(); ++k) stretch[k] = loop[loop.before(i, 2) + k].at;
    FoldRepairs repairs = possible_repairs(stretch);
    const auto is_end = [&](std::size_t k) { return !closed && (k == 0 || k == n - 1); };
    const bool repeats = stretch[1] == stretch[3] || stretch[2] == stretch[4];
    if (is_end(i) || is_end(next) || repeats) repairs.exchanged.reset();
    if (is_end(i)) repairs.without_first.reset();
    if (is_end(next)) repairs.without_second.reset();
    if (!repairs.without_first && !repairs.without_second) return FoldMend::none;

    const double first = repairs.without_first.value_or(HUGE_VAL), second = repairs.without_second.value_or(HUGE_VAL);
    const bool both = repairs.without_first && repairs.without_second;
    if (both && repairs.exchanged &&
        *repairs.exchanged <= most_bending_ratio * std::min(first, second) + most_further_bending) {
        std::swap(points[i], points[next]);
        return FoldMend::exchanged;
    }
    left_out = first <= second ? i : next;
    return FoldMend::left_out;
}

/// Leaves out a point, and the next one, too, where it is the same as the one before.
void leave_out(SourcePoints& points, std::size_t i) {
    assert(i < points.size() && points.size() > 4);
    const auto erase = [&](std::size_t k) { points.erase(points.begin() + static_cast<std::ptrdiff_t>(k)); };
    erase(i);
    const std::size_t next = i % points.size(), before = (i + points.size() - 1) % points.size();
    if (points[next].at == points[before].at) erase(next);
}

}  // namespace

std::optional<Fold> mend_fold(SourcePoints& points, bool closed) {
    constexpr std::size_t min_points = 8;
    constexpr double max_wide_share = 0.01;
    if (points.size() < min_points) return std::nullopt;
    const Loop loop(points);
    const double size = extent(points);
    Turn turn = loop.turn(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Turn last = std::exchange(turn, loop.turn(i + 1));
        Fold fold{loop[i], loop[i + 1], distance(loop[i].at, loop[i + 1].at) / size};
        const double min_cosine = fold.share <= max_wide_share ? cos_40_deg : cos_15_deg;
        if (!last.reverses(min_cosine) || !turn.reverses(min_cosine)) continue;
        std::size_t left_out = i;
        fold.mend = mend_between(points, i, closed, left_out);
        if (fold.mend == FoldMend::none) continue;
        if (fold.mend == FoldMend::left_out) {
            if (left_out != i) std::swap(fold.first, fold.second);
            leave_out(points, left_out);
        }
        return fold;
    }
    return std::nullopt;
}

std::vector<Fold> find_narrow_folds(const SourcePoints& points) {
    constexpr double max_share = 0.5;
    const Loop loop(points);
    const std::size_t n = points.size();
    const double size = extent(points);
    std::vector<Fold> folds;
    std::optional<std::size_t> start;  // the last point where the outline reversed, while it has been smooth since
    double length = 0;
    // The second round closes the fold that the end of the list divides.
    for (std::size_t i = 0; i < 2 * n && (i < n || start); ++i) {
        length += distance(loop[i + n - 1].at, loop[i].at);
        const Turn turn = loop.turn(i % n);
        if (turn.is_smooth()) continue;
        if (start && turn.reverses(cos_15_deg) && turn.opposes(loop.turn(*start)) && length <= max_share * size)
            folds.push_back({loop[*start], loop[i], length / size});
        start.reset();
        if (turn.reverses(cos_15_deg) && i < n) start = i;
        length = 0;
    }
    return folds;
}

}  // namespace lamina::geometry
