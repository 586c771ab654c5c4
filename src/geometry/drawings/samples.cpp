#include "geometry/drawings/samples.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"

namespace lamina::geometry {

namespace {

constexpr double max_turning = core::radians(4);  // along one edge
constexpr double max_edge_share = 0.01;           // of an edge on a curve
constexpr double max_ratio = 2.1;                 // of neighbouring edges
constexpr double min_corner = core::radians(1);
/// Polylines beside curves may be samples of curves, too. A vertex between two of their sides is a corner where it
/// turns by this, or one side is longer than this share.
constexpr double min_corner_of_sides = core::radians(10), long_side_share = 0.05;
constexpr double min_length_share = 1e-9;
constexpr std::size_t max_samples = 2'000'000;

/// A part of a curve between two of its parameters, in the direction of the chain.
struct CurvePart {
    const FlatCurve* drawn;
    double from, to;
    Point a, b;
    bool is_graded = false;  ///< whether neighbours have to be of about its length
    bool is_corner = false;  ///< whether the chain turns at its start

    bool is_straight() const { return drawn->curve.is_straight(); }
    Point at(double share) const { return geometry::at(drawn->curve, from + share * (to - from)); }
    double length() const { return distance(a, b); }
    /// Returns the direction at its start or its end, along the chain.
    Point direction_at(double parameter, bool is_start) const {
        const bool is_forward = from < to;
        const Point d = direction(drawn->curve, parameter, is_forward == is_start);
        return is_forward ? d : -d;
    }
};

std::vector<CurvePart> parts_of(std::span<const FlatCurve> curves, const Chain& chain) {
    std::vector<CurvePart> parts;
    for (const ChainLink& link : chain.links) {
        const FlatCurve& drawn = curves[link.curve];
        std::vector<double> ends = piece_ends(drawn.curve);
        if (link.is_reversed) std::reverse(ends.begin(), ends.end());
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            const Point a = at(drawn.curve, ends[i]), b = at(drawn.curve, ends[i + 1]);
            if (drawn.curve.is_straight() && a == b) continue;
            parts.push_back({&drawn, ends[i], ends[i + 1], a, b, !drawn.curve.is_straight()});
        }
    }
    return parts;
}

/// Marks the parts at whose start a chain turns at once.
void find_corners(std::vector<CurvePart>& parts, bool is_closed, double size) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i == 0 && !is_closed) continue;
        CurvePart& after = parts[i];
        const CurvePart& before = parts[(i + parts.size() - 1) % parts.size()];
        const Point in = before.direction_at(before.to, false), out = after.direction_at(after.from, true);
        const double turning = std::abs(core::angle_between(in, out));
        const bool are_sides = before.is_straight() && after.is_straight() &&
                               std::max(before.length(), after.length()) < long_side_share * size;
        after.is_corner = turning > (are_sides ? min_corner_of_sides : min_corner);
    }
}

/// Returns whether an edge from the start of a part to its end is too coarse.
bool is_coarse(const CurvePart& part, double size, double max_deviation) {
    if (part.is_straight()) return false;
    std::array<Point, 5> p{part.a, part.at(0.25), part.at(0.5), part.at(0.75), part.b};
    double deviation = 0, turning = 0, length = 0;
    for (std::size_t i = 1; i < p.size(); ++i) length += distance(p[i - 1], p[i]);
    if (length < min_length_share * size) return false;
    for (std::size_t i = 1; i < 4; ++i) {
        deviation = std::max(deviation, core::distance_to_segment(p[i], part.a, part.b));
        turning += std::abs(core::angle_between(p[i] - p[i - 1], p[i + 1] - p[i]));
    }
    return deviation > max_deviation || turning > max_turning || length > max_edge_share * size;
}

std::pair<CurvePart, CurvePart> halves(const CurvePart& part) {
    const double middle = 0.5 * (part.from + part.to);
    CurvePart first = part, second = part;
    first.to = second.from = middle;
    first.b = second.a = part.at(0.5);
    first.is_graded = second.is_graded = true;
    second.is_corner = false;
    return {first, second};
}

/// Divides the parts that are too coarse.
std::vector<CurvePart> divided(const std::vector<CurvePart>& parts, double size, double max_deviation) {
    constexpr std::size_t max_depth = 40;
    struct Task {
        CurvePart part;
        std::size_t depth;
    };
    std::vector<CurvePart> result;
    std::vector<Task> tasks;
    for (const CurvePart& part : parts) {
        tasks.push_back({part, 0});
        while (!tasks.empty() && result.size() <= max_samples) {
            const Task task = tasks.back();
            tasks.pop_back();
            if (task.depth == max_depth || !is_coarse(task.part, size, max_deviation)) {
                result.push_back(task.part);
                continue;
            }
            const auto [first, second] = halves(task.part);
            tasks.push_back({second, task.depth + 1});
            tasks.push_back({first, task.depth + 1});
        }
    }
    return result;
}

/// Divides parts that are much longer than a neighbour, across no corner, until none is.
std::vector<CurvePart> graded(std::vector<CurvePart> parts, bool is_closed) {
    constexpr int max_rounds = 64;
    for (int round = 0; round < max_rounds && parts.size() <= max_samples; ++round) {
        const std::size_t n = parts.size();
        std::vector<bool> is_long(n);
        const auto compare = [&](std::size_t i, std::size_t j) {  // part j follows part i
            if (parts[j].is_corner) return;
            const double a = parts[i].length(), b = parts[j].length();
            if (parts[j].is_graded && a > max_ratio * b) is_long[i] = true;
            if (parts[i].is_graded && b > max_ratio * a) is_long[j] = true;
        };
        for (std::size_t i = 0; i + 1 < n; ++i) compare(i, i + 1);
        if (is_closed && n > 1) compare(n - 1, 0);
        if (std::find(is_long.begin(), is_long.end(), true) == is_long.end()) break;
        std::vector<CurvePart> finer;
        finer.reserve(n + n / 4);
        for (std::size_t i = 0; i < n; ++i) {
            if (!is_long[i]) {
                finer.push_back(parts[i]);
                continue;
            }
            const auto [first, second] = halves(parts[i]);
            finer.push_back(first);
            finer.push_back(second);
        }
        parts = std::move(finer);
    }
    return parts;
}

}  // namespace

std::vector<Point> rough_points(std::span<const FlatCurve> curves, const Chain& chain) {
    constexpr std::size_t samples_of_piece = 6;
    std::vector<Point> points;
    for (const CurvePart& part : parts_of(curves, chain)) {
        const std::size_t count = part.is_straight() ? 1 : samples_of_piece;
        for (std::size_t k = 0; k < count; ++k)
            points.push_back(part.at(static_cast<double>(k) / static_cast<double>(count)));
        points.push_back(part.b);
    }
    return points;
}

SampledChain sample(std::span<const FlatCurve> curves, const Chain& chain, double size, double max_deviation,
                    const std::string& file) {
    SampledChain result;
    std::vector<CurvePart> parts = parts_of(curves, chain);
    result.has_curves = std::any_of(parts.begin(), parts.end(), [](const CurvePart& p) { return !p.is_straight(); });
    if (result.has_curves) {
        find_corners(parts, chain.is_closed, size);
        parts = graded(divided(parts, size, max_deviation), chain.is_closed);
    }
    assert(!parts.empty());
    if (parts.size() > max_samples)
        throw InputError({file, curves[chain.links[0].curve].line, {}},
                         fmt::format("an outline that needs more than {} points", max_samples));
    for (const CurvePart& part : parts) result.points.push_back({part.a, part.drawn->line, part.is_corner});
    const CurvePart& last = parts.back();
    // Rounding leaves numbers beside 0 that predicates would not be exact with.
    constexpr double least = 1e-60;
    result.points.push_back(chain.is_closed ? result.points.front() : SourcePoint{last.b, last.drawn->line});
    for (SourcePoint& p : result.points) {
        if (std::abs(p.at.x) < least) p.at.x = 0;
        if (std::abs(p.at.y) < least) p.at.y = 0;
    }
    return result;
}

}  // namespace lamina::geometry
