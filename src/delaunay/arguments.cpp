#include "delaunay/arguments.hpp"

#include <vector>

#include <lamina/error.hpp>

#include "core/arguments.hpp"
#include "core/text.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

void check_points(std::span<const Point> points) {
    if (points.size() > max_triangles / 2)
        throw InputError(
            {}, core::concat(points.size(), " points are more than the ", max_triangles / 2, " of one triangulation"));
    core::require_exact_range(points, "point");
}

void check_points_and_segments(std::span<const Point> points, std::span<const Segment> segments) {
    check_points(points);
    core::require_indices_below(points.size(), segments);
}

void check_arguments(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                     const ConstrainedRefineOptions& options) {
    validate(options.refine);
    check_points(points);
    core::require_exact_range(triangulation.steiner_points, "Steiner point");
    std::vector<Point> seeds;
    for (const RegionSize& region : options.regions) seeds.push_back(region.seed);
    core::require_exact_range(seeds, "region");
    const std::size_t vertices = points.size() + triangulation.steiner_points.size();
    core::require_indices_below(vertices, triangulation.triangles);
    core::require_indices_below(vertices, triangulation.segments);
    core::require_count(triangulation.parents.size(), "parents", triangulation.segments.size(), "segments");
}

}  // namespace lamina::delaunay
