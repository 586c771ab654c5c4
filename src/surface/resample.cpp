// An outline loses samples that say little, is cut at its corners, and each stretch between two corners is replaced by
// a spline that is divided anew.
#include "surface/resample.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/bounding_box.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "surface/corners.hpp"
#include "surface/divide_curves.hpp"
#include "surface/notes.hpp"
#include "surface/smooth_run.hpp"
#include "surface/spline.hpp"

namespace lamina::surface {

namespace {

/// A sample is close to another one where their distance is below this share of the next edge.
constexpr double max_close_share = 0.1;

/// A closed outline and its corners, ascending.
struct CorneredOutline {
    std::vector<Point> points;
    std::vector<std::size_t> corners;
};

/// Replaces each pair of samples that are much closer to each other than to the next ones by one point, since such a
/// pair tells little but its rounding. Pairs whose point would be a corner stay, as at a narrow base, and so do pairs
/// that are `max_pair_length` apart or more, where one of the two is misplaced.
CorneredOutline merge_close_pairs(const Element& element, double max_pair_length) {
    const std::vector<Point>& points = element.points;
    const std::size_t n = points.size();
    const auto length_after = [&](std::size_t i) { return distance(points[i % n], points[(i + 1) % n]); };
    std::vector<bool> is_merged(n);  // whether a point is merged with the next one
    for (std::size_t i = 0; n >= 5 && i < n; ++i)
        is_merged[i] = length_after(i) < std::min(max_pair_length, max_close_share * std::min(length_after(i + n - 1),
                                                                                              length_after(i + 1)));
    if (std::find(is_merged.begin(), is_merged.end(), true) == is_merged.end())
        return {points, element.features.corners};

    std::vector<std::size_t> origins;  // indices in `points` of the kept points
    const auto kept_points = [&] {
        std::vector<Point> kept;
        origins.clear();
        for (std::size_t i = 0; i < n; ++i) {
            if (is_merged[(i + n - 1) % n]) continue;
            kept.push_back(is_merged[i] ? midpoint(points[i], points[(i + 1) % n]) : points[i]);
            origins.push_back(i);
        }
        return kept;
    };
    for (std::size_t corner : find_corners(kept_points())) is_merged[origins[corner]] = false;
    std::vector<Point> kept = kept_points();
    std::vector<std::size_t> corners = find_corners(kept);
    return {std::move(kept), std::move(corners)};
}

/// Drops the sample beside a corner that is much closer to the corner than to the next sample, and within the tolerance
/// of the straight line between the two.
void drop_close_to_corners(SmoothRun& run, double tolerance) {
    std::vector<Point>& p = run.points;
    const auto is_close = [&](Point corner, Point sample, Point next) {
        return distance(corner, sample) < max_close_share * distance(sample, next) &&
               core::distance_to_segment(sample, corner, next) < tolerance;
    };
    if (run.closed) return;
    if (p.size() > 3 && is_close(p[0], p[1], p[2])) p.erase(p.begin() + 1);
    if (p.size() > 3 && is_close(p.back(), p[p.size() - 2], p[p.size() - 3])) p.erase(p.end() - 2);
}

SpacingRule make_spacing_rule(const ResamplingRequest& request, double scale, std::size_t element) {
    const SurfaceOptions& options = request.options;
    // The bound on turning holds for the mean over two edges, of which gradation makes one longer.
    constexpr double turning_share = 0.85;
    SpacingRule rule;
    rule.max_spacing = options.max_spacing * scale;
    rule.min_spacing = options.min_spacing * scale;
    rule.max_turning = turning_share * core::radians(request.max_turning_deg());
    rule.tolerance = options.tolerance * scale;
    // Edges that equidistribute ds/h with dh/ds = g grow by exp(g). The largest g is ln(max_ratio), which this
    // approximant stays below. The margin is for chords, which are shorter than their arcs.
    constexpr double margin = 0.97;
    rule.gradation = std::min(
        {margin * 2 * (options.max_ratio - 1) / (options.max_ratio + 1), options.gradation, request.limits.gradation});
    rule.max_corner_ratio = options.max_ratio;
    for (const WallSpacing& wall : request.limits.walls)
        if (wall.element == element) rule.walls.push_back(wall);
    rule.clearance_share = options.gap_spacing;
    rule.clearance = [&walls = request.walls, element, min_own_clearance = options.corner_spacing * scale,
                      max_clearance = rule.max_spacing / options.gap_spacing](Point p, Point normal) {
        return walls.clearance(element, p, normal, min_own_clearance, max_clearance);
    };
    return rule;
}

/// Returns the largest spacing at each corner, or no bound for an outline without corners.
std::vector<double> corner_spacings(const CorneredOutline& outline, const ResamplingRequest& request, double scale) {
    if (outline.corners.empty()) return {HUGE_VAL};
    const SurfaceOptions& options = request.options;
    const std::vector<double> turning = turning_angles(outline.points);
    const double spacing_by_options = options.sharp_corner_spacing * scale;
    const std::optional<double>& fan_spacing = request.limits.fan_spacing;
    const double sharp_spacing =
        fan_spacing ? std::clamp(*fan_spacing, 0.25 * spacing_by_options, options.corner_spacing * scale)
                    : spacing_by_options;
    std::vector<double> spacings;
    for (std::size_t c : outline.corners)
        spacings.push_back(turning[c] > core::radians(sharp_corner_deg) ? sharp_spacing
                                                                        : options.corner_spacing * scale);
    return spacings;
}

/// Returns, per new point, the line of the file if a given point stands there, as at corners, else 0.
std::vector<std::size_t> lines_of(const Element& given, const std::vector<Point>& points) {
    std::vector<std::pair<Point, std::size_t>> given_lines;
    for (std::size_t i = 0; i < given.lines.size(); ++i) given_lines.emplace_back(given.points[i], given.lines[i]);
    const auto less = [](const auto& a, const auto& b) { return lexicographically_less(a.first, b.first); };
    std::sort(given_lines.begin(), given_lines.end(), less);
    std::vector<std::size_t> lines;
    for (Point p : points) {
        const auto at = std::lower_bound(given_lines.begin(), given_lines.end(), std::pair{p, std::size_t{0}}, less);
        lines.push_back(at != given_lines.end() && at->first == p ? at->second : 0);
    }
    return lines;
}

}  // namespace

double extent(std::span<const Point> outline) { return core::longer_side(core::bounding_box(outline)); }

Element resample(const Element& given, std::size_t index, const ResamplingRequest& request, const std::string& reason) {
    constexpr double max_pair_share = 1e-3;  // of the extent
    const SurfaceOptions& options = request.options;
    const double scale = extent(given.points);
    const CorneredOutline outline = merge_close_pairs(given, max_pair_share * scale);
    std::vector<SplineCurve> curves;
    for (SmoothRun& run : split_at_corners(outline.points, outline.corners)) {
        drop_close_to_corners(run, 0.5 * options.tolerance * scale);
        curves.emplace_back(run);
    }
    const SpacingRule rule = make_spacing_rule(request, scale, index);
    const std::vector<double> corner_spacing_bounds = corner_spacings(outline, request, scale);

    DividedCurves divided = options.points ? divide_curves_into(curves, corner_spacing_bounds, rule, *options.points)
                                           : divide_curves(curves, corner_spacing_bounds, rule);
    // Where lamina decides by itself, it never takes points away from a fine outline.
    if (!options.points && options.treatment == SurfaceTreatment::automatic && !given.samples_of_curve &&
        divided.points.size() < given.points.size())
        divided = divide_curves_into(curves, corner_spacing_bounds, rule, given.points.size());

    Element element = given;
    element.points = std::move(divided.points);
    element.lines = lines_of(given, element.points);
    element.resampled = true;
    element.features.corners = outline.corners.empty() ? std::vector<std::size_t>{} : std::move(divided.starts);
    element.surface_notes.push_back(
        fmt::format("{} points resampled to {}: {}; {} kept, edges within {:.2g} of the spline", given.points.size(),
                    element.points.size(), reason, counted(outline.corners.size(), "corner"), divided.deviation));
    return element;
}

}  // namespace lamina::surface
