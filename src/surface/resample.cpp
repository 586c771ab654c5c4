// An outline is cleaned of samples that say little, cut at its corners, and each stretch between two corners replaced
// by a spline that is divided anew.
#include "surface/resample.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "surface/corners.hpp"
#include "surface/notes.hpp"
#include "surface/spacing.hpp"

namespace lamina::surface {

namespace {

/// A closed outline and its corners, ascending.
struct Outline {
    std::vector<Point> points;
    std::vector<std::size_t> corners;
};

/// Two samples much closer to each other than to the next ones say little but their rounding: one point takes their
/// place. Pairs that would become a corner stay, as at a narrow base, and so do pairs that are `widest_pair` apart or
/// more, of which one is misplaced.
Outline without_close_pairs(const Element& element, double widest_pair) {
    constexpr double close = 0.1;
    const std::vector<Point>& points = element.points;
    const std::size_t n = points.size();
    const auto length_after = [&](std::size_t i) { return distance(points[i % n], points[(i + 1) % n]); };
    std::vector<bool> merged(n);  // with the point after
    for (std::size_t i = 0; n >= 5 && i < n; ++i)
        merged[i] =
            length_after(i) < std::min(widest_pair, close * std::min(length_after(i + n - 1), length_after(i + 1)));
    if (std::find(merged.begin(), merged.end(), true) == merged.end()) return {points, element.features.corners};

    std::vector<std::size_t> origins;
    const auto kept_points = [&] {
        std::vector<Point> kept;
        origins.clear();
        for (std::size_t i = 0; i < n; ++i) {
            if (merged[(i + n - 1) % n]) continue;
            kept.push_back(merged[i] ? midpoint(points[i], points[(i + 1) % n]) : points[i]);
            origins.push_back(i);
        }
        return kept;
    };
    for (std::size_t corner : find_corners(kept_points())) merged[origins[corner]] = false;
    std::vector<Point> kept = kept_points();
    std::vector<std::size_t> corners = find_corners(kept);
    return {std::move(kept), std::move(corners)};
}

/// Drops the sample beside a corner that is much closer to the corner than to the next sample and on the way there.
void drop_close_to_corners(SmoothRun& run, double tolerance) {
    constexpr double close = 0.1;
    std::vector<Point>& p = run.points;
    const auto is_close = [&](Point corner, Point sample, Point next) {
        return distance(corner, sample) < close * distance(sample, next) &&
               core::distance_to_segment(sample, corner, next) < tolerance;
    };
    if (run.closed) return;
    if (p.size() > 3 && is_close(p[0], p[1], p[2])) p.erase(p.begin() + 1);
    if (p.size() > 3 && is_close(p.back(), p[p.size() - 2], p[p.size() - 3])) p.erase(p.end() - 2);
}

SpacingRule spacing_rule(const Resampling& how, double scale, std::size_t element) {
    const SurfaceOptions& options = how.options;
    // Turning is met on the average over two edges; gradation takes a part of it.
    constexpr double turning_share = 0.85;
    SpacingRule rule;
    rule.longest = options.max_spacing * scale;
    rule.shortest = options.min_spacing * scale;
    rule.turning = turning_share * core::radians(how.max_turning_deg());
    rule.tolerance = options.tolerance * scale;
    // Edges that equidistribute ds/h with dh/ds = g grow by exp(g); this approximant of ln(ratio) is below it. A margin
    // for chords, which are shorter than their arcs.
    constexpr double margin = 0.97;
    rule.growth = std::min(
        {margin * 2 * (options.max_ratio - 1) / (options.max_ratio + 1), options.gradation, how.limits.gradation});
    rule.worst_ratio = options.max_ratio;
    rule.room_share = options.gap_spacing;
    rule.room = [&walls = how.walls, element, least_own = options.corner_spacing * scale,
                 most = rule.longest / options.gap_spacing](Point p, Point normal) {
        return walls.room(element, p, normal, least_own, most);
    };
    return rule;
}

std::vector<double> corner_spacings(const Outline& outline, const Resampling& how, double scale) {
    if (outline.corners.empty()) return {HUGE_VAL};
    const SurfaceOptions& options = how.options;
    const std::vector<double> turning = turnings(outline.points);
    const double by_share = options.sharp_corner_spacing * scale;
    const double at_sharp = how.limits.fan_spacing
                                ? std::clamp(*how.limits.fan_spacing, 0.25 * by_share, options.corner_spacing * scale)
                                : by_share;
    std::vector<double> spacings;
    for (std::size_t c : outline.corners)
        spacings.push_back(turning[c] > core::radians(sharp_corner_deg) ? at_sharp : options.corner_spacing * scale);
    return spacings;
}

/// Returns the lines of the file for the points that still stand there: corners, as a rule.
std::vector<std::size_t> lines_of(const Element& given, const std::vector<Point>& points) {
    std::vector<std::pair<Point, std::size_t>> known;
    for (std::size_t i = 0; i < given.lines.size(); ++i) known.emplace_back(given.points[i], given.lines[i]);
    const auto less = [](const auto& a, const auto& b) { return lexicographically_less(a.first, b.first); };
    std::sort(known.begin(), known.end(), less);
    std::vector<std::size_t> lines;
    for (Point p : points) {
        const auto at = std::lower_bound(known.begin(), known.end(), std::pair{p, std::size_t{0}}, less);
        lines.push_back(at != known.end() && at->first == p ? at->second : 0);
    }
    return lines;
}

}  // namespace

double extent(std::span<const Point> outline) {
    Box box;
    for (Point p : outline) box.include(p);
    return std::max(box.width(), box.height());
}

std::vector<SmoothRun> split_at_corners(std::span<const Point> outline, std::span<const std::size_t> corners) {
    const std::size_t n = outline.size();
    if (corners.empty()) return {{{outline.begin(), outline.end()}, true}};
    std::vector<SmoothRun> runs;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::size_t end = k + 1 < corners.size() ? corners[k + 1] : corners[0] + n;
        SmoothRun& run = runs.emplace_back();
        for (std::size_t i = corners[k]; i <= end; ++i) run.points.push_back(outline[i % n]);
    }
    return runs;
}

Element resampled(const Element& given, std::size_t index, const Resampling& how, const std::string& reason) {
    constexpr double widest_pair = 1e-3;
    const SurfaceOptions& options = how.options;
    const double scale = extent(given.points);
    const Outline outline = without_close_pairs(given, widest_pair * scale);
    std::vector<Curve> curves;
    for (SmoothRun& run : split_at_corners(outline.points, outline.corners)) {
        drop_close_to_corners(run, 0.5 * options.tolerance * scale);
        curves.emplace_back(run);
    }
    const SpacingRule rule = spacing_rule(how, scale, index);
    const std::vector<double> at_corners = corner_spacings(outline, how, scale);

    Division division =
        options.points ? divide_into(curves, at_corners, rule, *options.points) : divide(curves, at_corners, rule);
    // Left to decide, lamina never takes points away from a fine outline.
    if (!options.points && options.surface == Surface::automatic && division.points.size() < given.points.size())
        division = divide_into(curves, at_corners, rule, given.points.size());

    Element element = given;
    element.points = std::move(division.points);
    element.lines = lines_of(given, element.points);
    element.resampled = true;
    element.features.corners = outline.corners.empty() ? std::vector<std::size_t>{} : std::move(division.starts);
    element.surface_notes.push_back(
        fmt::format("{} points resampled to {}: {}; {} kept, edges within {:.2g} of the spline", given.points.size(),
                    element.points.size(), reason, counted(outline.corners.size(), "corner"), division.deviation));
    return element;
}

}  // namespace lamina::surface
