// Stage "close the border": the fronts are divided, and all points of the layer placed. Source: J. K. Pardue, thesis
// (2015), chapter 3.
#include <utility>

#include <lamina/layers.hpp>

#include "layers/coverage.hpp"
#include "layers/divide_borders.hpp"
#include "layers/front.hpp"
#include "layers/insert_rays.hpp"
#include "layers/layer_builder.hpp"
#include "layers/layered_rays.hpp"

namespace lamina::layers {

namespace {

using FrontCorners = std::vector<std::vector<FrontCorner>>;

/// Divides the fronts through these corners. ray_factors: DividedRays::target_factors, or empty.
BorderDivision divide_fronts(const LayeredRays& rays, const FrontCorners& corners, const BorderOptions& options,
                             std::span<const double> ray_factors) {
    std::vector<std::vector<Point>> fronts(corners.size()), walls(corners.size());
    std::vector<std::vector<double>> target_factors(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e) {
        for (const FrontCorner& corner : corners[e]) {
            fronts[e].push_back(rays.tip(corner.ray));
            target_factors[e].push_back(ray_factors.empty() ? 0 : ray_factors[corner.ray]);
        }
        for (std::size_t i = rays.set.begin[e]; i < rays.set.begin[e + 1]; ++i)
            if (const Point origin = rays.set.lines[i].origin; walls[e].empty() || walls[e].back() != origin)
                walls[e].push_back(origin);
    }
    return divide_borders(fronts, walls, options, target_factors);
}

/// Returns the rays of all elements and, on resampled elements, further ones below the points where these options
/// divide the front. Rows of cells then run on to the wall instead of fanning out below division points.
DividedRays insert_rays_at_divisions(const Rays& rays, const BorderOptions& options) {
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(layered);
    const BorderDivision division = divide_fronts(layered, corners, options, {});
    // The edges between inserted rays are shorter than the target. If they requested their own length, their neighbours
    // would be divided for it, and the neighbours of these in turn. So each requests its length times a factor.
    std::vector<std::vector<double>> shares(rays.set.lines.size()), target_factors(rays.set.lines.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k) {
            const auto [ray, layers] = corners[e][k];
            const FrontCorner& after = corners[e][(k + 1) % corners[e].size()];
            if (!rays.resampled[e] || layers == 0 || after.layers == 0) continue;
            const Point from = layered.tip(ray);
            const double length = distance(from, layered.tip(after.ray));
            for (Point p : division.points[e][k]) shares[ray].push_back(distance(from, p) / length);
            target_factors[ray] = division.target_factors[e][k];
        }
    return insert_rays(rays.set, shares, target_factors);
}

}  // namespace

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

Layer close_border(Rays rays, const BorderOptions& options) {
    validate(options);
    std::vector<double> ray_factors;
    if (rays.enabled && options.ray_gradation) {
        BorderOptions ray_options = options;
        ray_options.gradation = *options.ray_gradation;
        DividedRays divided = insert_rays_at_divisions(rays, ray_options);
        if (replace_rays(std::move(divided.set), rays)) {
            ray_factors = std::move(divided.target_factors);
            fit_and_count_layers(rays);
        }
    }
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(layered);
    Layer layer = build_layer(rays, corners, divide_fronts(layered, corners, options, ray_factors));
    if (rays.enabled) layer.coverage = layer_coverage(rays.set, rays.heights, rays.counts);
    layer.growth = rays.growth;
    layer.edges = layer_edges(layer);
    return layer;
}

}  // namespace lamina
