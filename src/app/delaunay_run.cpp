#include "app/delaunay_run.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

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
    if (input.segments.empty() && input.holes.empty()) return triangulate_points(input, result);
    ConstrainedOptions options;
    options.holes = input.holes;
    options.crossings = settings.insert_crossings ? Crossings::insert : Crossings::refuse;
    if (!input.segments.empty() && !settings.keep_hull) options.keep = KeptRegion::inside_segments;
    return triangulate(input.points, input.segments, options);
}

/// Returns the size field whose triangles have at most this area. Where the area is not bounded, the sizes are larger
/// than all points together are wide.
SizeField size_field_for_area(double max_area, const std::vector<Point>& points) {
    Box extent;
    for (Point p : points) extent.include(p);
    const double squared_diagonal = extent.width() * extent.width() + extent.height() * extent.height();
    return SizeField(size_for_area(std::min(max_area, 16 * squared_diagonal)));
}

ConstrainedRefinement refine_input(const TriangleInput& input, const ConstrainedTriangulation& triangulation,
                                   const DelaunaySettings& settings) {
    ConstrainedRefineOptions options;
    options.refine = settings.refine;
    options.split_segments = !settings.keep_border;
    for (const TriangleRegion& region : input.regions) {
        const double max_area = region.max_area > 0 ? std::min(region.max_area, settings.max_area) : settings.max_area;
        options.regions.push_back({region.at, size_field_for_area(max_area, input.points)});
    }
    return refine(input.points, triangulation, size_field_for_area(settings.max_area, input.points), options);
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

}  // namespace

DelaunayResult run_delaunay(TriangleInput input, const DelaunaySettings& settings) {
    DelaunayResult result;
    Stopwatch watch;
    ConstrainedTriangulation triangulation =
        with_file_name(input, [&] { return triangulate_input(input, settings, result); });
    result.triangulation_seconds = watch.lap();
    result.zero_length_segments = triangulation.zero_length_segments;
    result.repeated_segments = triangulation.repeated_segments;

    ConstrainedRefinement mesh;
    if (needs_refinement(input, settings))
        mesh = with_file_name(input, [&] { return refine_input(input, triangulation, settings); });
    else
        mesh = unrefined(std::move(triangulation));
    result.refinement_seconds = watch.lap();
    result.refinement = mesh.stats;
    result.output = make_output(std::move(input), std::move(mesh));
    return result;
}

}  // namespace lamina::app
