#include "app/delaunay_run.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>
#include <lamina/threads.hpp>

#include "app/stopwatch.hpp"

namespace lamina::app {

namespace {

/// Returns the reason of an error with segments named as the file numbers their vertices, and with their lines. The
/// library names segments by indices.
std::string reason_in_numbers_of_file(const TriangleInput& input, const InputError& error) {
    std::string reason = error.reason();
    bool renamed = false;
    for (const std::size_t i : error.place().segments) {
        if (i >= input.segments.size()) continue;
        const auto [a, b] = input.segments[i];
        const std::string name = fmt::format("segment {} ({}-{})", i, a.value, b.value);
        const std::size_t at = reason.find(name);
        if (at == std::string::npos) continue;
        reason.replace(at, name.size(),
                       fmt::format("segment {}-{} (line {})", a.index() + input.first_index,
                                   b.index() + input.first_index, input.segment_lines[i]));
        renamed = true;
    }
    return renamed ? reason : reason + " (counted from 0)";
}

/// Calls f() and adds the name of the file to its errors, which give points and segments by their indices.
template <class F>
auto with_file_name(const TriangleInput& input, F&& f) {
    try {
        return f();
    } catch (const InputError& error) {
        if (!error.place().file.empty()) throw;
        InputPlace place = error.place();
        place.file = (input.segment_file.empty() ? input.point_file : input.segment_file).string();
        throw InputError(place, reason_in_numbers_of_file(input, error));
    }
}

/// Triangulates points without segments in pieces, on all threads.
ConstrainedTriangulation triangulate_points(const TriangleInput& input, DelaunayResult& result) {
    Triangulation pieces = triangulate(input.points);
    result.decomposition = pieces.decomposition;
    result.threads = std::move(pieces.threads);
    ConstrainedTriangulation triangulation;
    triangulation.triangles = std::move(pieces.triangles);
    return triangulation;
}

ConstrainedTriangulation triangulate_input(const TriangleInput& input, const DelaunaySettings& settings,
                                           DelaunayResult& result) {
    if (input.segments.empty() && input.holes.empty() && !settings.merge_distance && settings.drop_flat == 0)
        return triangulate_points(input, result);
    ConstrainedOptions options;
    options.holes = input.holes;
    options.merge_distance = settings.merge_distance;
    options.drop_flat = settings.drop_flat;
    options.crossings = settings.insert_crossings ? Crossings::insert : Crossings::refuse;
    if (!input.segments.empty() && !settings.keep_hull) options.keep = KeptRegion::inside_segments;
    ConstrainedTriangulation triangulation = triangulate(input.points, input.segments, options);
    for (std::size_t i = 0; i < triangulation.merged_into.size(); ++i)
        result.merged_points += triangulation.merged_into[i] != i;
    return triangulation;
}

/// Areas are bounded exactly, and the fewest triangles are wanted, so this is nearer to 1 than the default.
constexpr double max_area_ratio = 1.1;

/// Returns the size field whose triangles have at most this area. Where the area is not bounded, the sizes are larger
/// than all points together are wide.
SizeField size_field_for_area(double max_area, const std::vector<Point>& points) {
    Box extent;
    for (Point p : points) extent.include(p);
    const double squared_diagonal = extent.width() * extent.width() + extent.height() * extent.height();
    return SizeField(size_for_area(std::min(max_area, 16 * squared_diagonal), max_area_ratio));
}

/// Throws LimitError where the triangulation of the points of the input would exceed the limits, and records its size.
void require_triangulation_within(const TriangleInput& input, const DelaunaySettings& settings,
                                  const Progress& progress, DelaunayResult& result) {
    result.estimate = estimate_run(2 * static_cast<double>(input.points.size()), triangulation_cost, thread_count());
    require_within(settings.limits, result.estimate, input.segments.empty() ? "max_triangles" : "max_memory",
                   fmt::format("the triangulation of {} points", input.points.size()));
    if (progress) progress({"triangulation", result.estimate});
}

/// Returns whether the areas of triangles have a bound anywhere.
bool bounds_areas(const TriangleInput& input, const DelaunaySettings& settings) {
    return std::isfinite(settings.max_area) ||
           std::any_of(input.regions.begin(), input.regions.end(),
                       [](const TriangleRegion& region) { return region.max_area > 0; });
}

/// Throws LimitError where the refinement would exceed the limits, and records its size. Returns its cost.
WorkCost require_refinement_within(const TriangleInput& input, const ConstrainedTriangulation& triangulation,
                                   const DelaunaySettings& settings, const SizeField& size,
                                   const ConstrainedRefineOptions& options, DelaunayResult& result) {
    // Beyond this many times the triangles of the triangulation, it is the areas that ask for them, or the angles do.
    constexpr double most_for_both = 4;
    const RefinementEstimate estimate = estimate_triangles(input.points, triangulation, size, options);
    const bool for_angles =
        estimate.by_sizes <
        std::max(estimate.by_angles, most_for_both * static_cast<double>(triangulation.triangles.size()));
    const WorkCost cost = for_angles ? angle_refinement_cost : refinement_cost;
    result.estimate = estimate_run(estimate.triangles(), cost, thread_count());
    const bool by_area = std::isfinite(settings.max_area);
    require_within(settings.limits, estimate_run(estimate.by_sizes, refinement_cost, thread_count()),
                   by_area ? "option --max-area" : "min_angle",
                   by_area ? fmt::format("{:.6g}", settings.max_area)
                           : fmt::format("{}, with the areas of the regions,", settings.refine.min_angle_deg));
    if (estimate.least_by_angles > allowed_triangles(settings.limits, angle_refinement_cost))
        throw_limit_error(settings.limits, estimate_run(estimate.by_angles, angle_refinement_cost, thread_count()),
                          "min_angle",
                          fmt::format("{}, with segments so close together,", settings.refine.min_angle_deg));
    return cost;
}

ConstrainedRefinement refine_input(const TriangleInput& input, const ConstrainedTriangulation& triangulation,
                                   const DelaunaySettings& settings, const Progress& progress, DelaunayResult& result) {
    ConstrainedRefineOptions options;
    options.refine = settings.refine;
    options.refine.max_area_ratio = max_area_ratio;
    options.split_segments = !settings.keep_border;
    for (const TriangleRegion& region : input.regions) {
        const double max_area = region.max_area > 0 ? std::min(region.max_area, settings.max_area) : settings.max_area;
        options.regions.push_back({region.at, size_field_for_area(max_area, input.points)});
    }
    const SizeField size = size_field_for_area(settings.max_area, input.points);
    const WorkCost cost = require_refinement_within(input, triangulation, settings, size, options, result);
    options.refine.max_points = allowed_points(settings.limits, cost, options.refine.max_points);
    if (progress) progress({"refinement", result.estimate});
    ConstrainedRefinement mesh = refine(input.points, triangulation, size, options);
    // The sizes that stand for no bound are finite, and flat triangles have circles that are larger.
    if (!bounds_areas(input, settings)) {
        mesh.stats.oversized = 0;
        if (mesh.stats.below_bound == mesh.stats.exempt) mesh.stats.refused = 0;
    }
    return mesh;
}

/// Returns whether refinement is needed. Regions without bounds need it as well, since it finds their triangles.
bool needs_refinement(const TriangleInput& input, const DelaunaySettings& settings) {
    return settings.refine.min_angle_deg > 0 || std::isfinite(settings.max_area) || !input.regions.empty();
}

/// Returns a triangulation in the form of a refinement without Steiner points of its own.
ConstrainedRefinement unrefined(ConstrainedTriangulation triangulation) {
    ConstrainedRefinement result;
    result.steiner_points = std::move(triangulation.steiner_points);
    result.triangles = std::move(triangulation.triangles);
    result.segments = std::move(triangulation.segments);
    result.parents = std::move(triangulation.parents);
    return result;
}

/// Gives each segment the marker of the segment that it is a part of, and vertices without a marker that of their first
/// segment with one.
void hand_down_markers(const std::vector<long>& input_markers, const std::vector<std::uint32_t>& parents,
                       TriangleOutput& output) {
    for (std::size_t i = 0; i < output.segments.size(); ++i) {
        const long marker = input_markers.empty() ? 0 : input_markers[parents[i]];
        output.segment_markers.push_back(marker);
        for (VertexId v : {output.segments[i].a, output.segments[i].b})
            if (output.markers[v.index()] == 0) output.markers[v.index()] = marker;
    }
}

TriangleOutput make_output(TriangleInput input, ConstrainedRefinement mesh) {
    TriangleOutput output;
    output.triangles = std::move(mesh.triangles);
    output.segments = std::move(mesh.segments);
    output.first_index = input.first_index;
    output.points = std::move(input.points);
    output.points.insert(output.points.end(), mesh.steiner_points.begin(), mesh.steiner_points.end());
    output.attribute_count = input.attribute_count;
    output.attributes = std::move(input.attributes);
    output.attributes.resize(output.points.size() * output.attribute_count, 0.0);
    output.markers = std::move(input.markers);
    output.markers.resize(output.points.size(), 0);
    hand_down_markers(input.segment_markers, mesh.parents, output);
    mark_boundary(output);
    if (!input.regions.empty())
        for (std::uint32_t region : mesh.regions)
            output.triangle_attributes.push_back(
                region == ConstrainedRefinement::no_region ? 0 : input.regions[region].attribute);
    output.holes = std::move(input.holes);
    output.regions = std::move(input.regions);
    return output;
}

/// Returns the middle of the triangle with the largest badness; the first of several.
template <class Badness>
Point worst_place(const TriangleOutput& output, Badness badness) {
    Point worst{};
    double worst_badness = -HUGE_VAL;
    for (const Triangle& t : output.triangles) {
        const Point a = output.points[t.v[0].index()], b = output.points[t.v[1].index()],
                    c = output.points[t.v[2].index()];
        if (const double value = badness(a, b, c); value > worst_badness) {
            worst_badness = value;
            worst = (1.0 / 3) * (a + b + c);
        }
    }
    return worst;
}

/// Returns why a triangulation is empty.
std::string reason_for_no_triangles(const TriangleOutput& output) {
    const std::vector<Point>& points = output.points;
    bool on_one_line = true;
    for (std::size_t i = 0, other = 0; on_one_line && i < points.size(); ++i) {
        if (points[other] == points[0]) other = i;
        on_one_line = orient2d(points[0], points[other], points[i]) == 0;
    }
    if (points.size() < 3) return "a triangle needs three points";
    if (on_one_line) return "all points lie on one line";
    if (output.holes.empty()) return "the segments enclose nothing (--keep-hull keeps what lies outside of them)";
    return output.segments.empty() ? "the holes take all of it away, since no segments bound them"
                                   : "the holes take all of it away";
}

Warning unused_seed_warning(const std::string& kind, std::size_t i, Point at, const std::string& reason) {
    return {.code = WarningCode::unused_seed,
            .at = at,
            .number = static_cast<double>(i + 1),
            .unit = kind,
            .message = fmt::format("{} {} at ({:.6g}, {:.6g}) {}", kind, i + 1, at.x, at.y, reason)};
}

/// Returns warnings of holes that take nothing away, as where they have other units.
std::vector<Warning> find_unused_holes(const TriangleInput& input, const std::vector<std::size_t>& idle_holes) {
    std::vector<Warning> warnings;
    Box box;
    for (const Point p : input.points) box.include(p);
    warnings.reserve(idle_holes.size());
    for (const std::size_t i : idle_holes)
        warnings.push_back(unused_seed_warning("hole", i, input.holes[i],
                                               box.contains(input.holes[i])
                                                   ? "takes nothing away: it lies outside of the segments, or where an "
                                                     "earlier hole does"
                                                   : "lies beyond all points and takes nothing away"));
    return warnings;
}

/// Returns warnings of regions that no triangle is in.
std::vector<Warning> find_unused_regions(const TriangleInput& input, const ConstrainedRefinement& mesh) {
    std::vector<Warning> warnings;
    std::vector<bool> used(input.regions.size());
    for (const std::uint32_t region : mesh.regions)
        if (region != ConstrainedRefinement::no_region) used[region] = true;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i])
            warnings.push_back(unused_seed_warning("region", i, input.regions[i].at,
                                                   "lies in no triangle, or where an earlier region does"));
    return warnings;
}

Warning no_triangles_warning(const TriangleOutput& output) {
    Warning warning{.code = WarningCode::no_triangles,
                    .number = static_cast<double>(output.points.size()),
                    .unit = "points",
                    .message = fmt::format("{} points, but no triangle: {}", output.points.size(),
                                           reason_for_no_triangles(output))};
    if (!output.holes.empty()) {
        warning.at = output.holes.front();
    } else if (!output.points.empty()) {
        warning.at = output.points.front();
    }
    return warning;
}

std::vector<Warning> find_warnings(const TriangleOutput& output, const RefineStats& stats,
                                   const DelaunaySettings& settings) {
    std::vector<Warning> warnings;
    if (output.triangles.empty()) warnings.push_back(no_triangles_warning(output));
    const auto add = [&](WarningCode code, std::size_t count, const std::string& unit, Point at,
                         const std::string& text) {
        if (count == 0) return;
        warnings.push_back({code, "", at, static_cast<double>(count), unit,
                            fmt::format("{} {} (worst at ({:.6g}, {:.6g}))", count, text, at.x, at.y)});
    };
    if (const std::size_t narrow = stats.below_bound - stats.exempt; narrow > 0 || stats.refused > 0) {
        // The squared sine of the smallest angle, but for a factor: squared area over the squared longer two edges.
        const Point at = worst_place(output, [](Point a, Point b, Point c) {
            const double ab = squared_length(b - a), bc = squared_length(c - b), ca = squared_length(a - c);
            const double area = cross(b - a, c - a);
            return -area * area / (ab * bc * ca) * std::min({ab, bc, ca});
        });
        add(WarningCode::small_angle, narrow, "triangles", at,
            fmt::format("triangles have an angle below the bound of {} degrees, and no sharp corner of the input "
                        "excuses them",
                        settings.refine.min_angle_deg));
        add(WarningCode::refused_points, stats.refused, "points", at,
            "points were left out, since they would encroach upon the border");
    }
    if (stats.oversized > 0)
        add(WarningCode::oversized_triangles, stats.oversized, "triangles",
            worst_place(output, [](Point a, Point b, Point c) { return cross(b - a, c - a); }),
            "triangles are larger than asked for");
    return warnings;
}

}  // namespace

DelaunayResult run_delaunay(TriangleInput input, const DelaunaySettings& settings, const Progress& progress) {
    if (input.points.empty()) throw InputError({.file = input.point_file.string()}, "the file holds no points");
    if (settings.drop_flat > 0 && !input.segments.empty() && !settings.keep_hull)
        throw UsageError("option --drop-flat needs --keep-hull: without it, segments bound the triangles");
    DelaunayResult result;
    Stopwatch watch;
    require_triangulation_within(input, settings, progress, result);
    ConstrainedTriangulation triangulation =
        with_file_name(input, [&] { return triangulate_input(input, settings, result); });
    result.triangulation_seconds = watch.lap();
    result.zero_length_segments = triangulation.zero_length_segments;
    result.repeated_segments = triangulation.repeated_segments;
    result.dropped_triangles = triangulation.dropped_triangles;
    result.warnings = find_unused_holes(input, triangulation.idle_holes);

    ConstrainedRefinement mesh;
    if (needs_refinement(input, settings))
        mesh = with_file_name(input, [&] { return refine_input(input, triangulation, settings, progress, result); });
    else
        mesh = unrefined(std::move(triangulation));
    result.refinement_seconds = watch.lap();
    result.refinement = mesh.stats;
    for (Warning& warning : find_unused_regions(input, mesh)) result.warnings.push_back(std::move(warning));
    result.output = make_output(std::move(input), std::move(mesh));
    require_made_within(settings.limits, static_cast<double>(result.output.triangles.size()), refinement_cost,
                        thread_count());
    for (Warning& warning : find_warnings(result.output, result.refinement, settings))
        result.warnings.push_back(std::move(warning));
    return result;
}

}  // namespace lamina::app
