// Fields spread from the triangles that hold the seeds of the regions.
#include "delaunay/refine/constrained_input.hpp"

#include <algorithm>

#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/link_triangles.hpp"

namespace lamina::delaunay {

namespace {

/// Returns ConstrainedInput::fields.
std::vector<std::uint32_t> find_fields(const ConstrainedInput& input, std::span<const RegionSize> regions) {
    std::vector<ValueSeed> seeds;
    for (std::uint32_t r = 0; r < regions.size(); ++r) {
        const Point seed = regions[r].seed;
        for (Index t = 0; t < input.tris.size(); ++t) {
            const Index* v = input.tris[t].v;
            const Point a = input.points[v[0]], b = input.points[v[1]], c = input.points[v[2]];
            if (orient2d(a, b, seed) < 0 || orient2d(b, c, seed) < 0 || orient2d(c, a, seed) < 0) continue;
            seeds.push_back({t, r + 1});
            break;
        }
    }
    if (seeds.empty()) return {};
    std::vector<std::uint32_t> fields = spread_values(input.tris, seeds);
    std::replace(fields.begin(), fields.end(), no_index, std::uint32_t{0});
    return fields;
}

}  // namespace

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

ConstrainedInput make_constrained_input(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                                        RegionSizes size, std::span<const RegionSize> regions) {
    ConstrainedInput input;
    input.points.assign(points.begin(), points.end());
    input.points.insert(input.points.end(), triangulation.steiner_points.begin(), triangulation.steiner_points.end());
    input.tris = link_triangles(triangulation.triangles, triangulation.segments);
    input.sizes.push_back(size);
    for (const RegionSize& region : regions) input.sizes.emplace_back(region.size);
    input.fields = find_fields(input, regions);
    return input;
}

}  // namespace lamina::delaunay
