// Stage "grow rays": directions, heights, room and counts. Source: J. K. Pardue, thesis (2015), chapter 3.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <lamina/layers.hpp>

#include "layers/counts.hpp"
#include "layers/fit_heights.hpp"
#include "layers/front.hpp"
#include "layers/heights.hpp"
#include "layers/layered_rays.hpp"
#include "layers/rays.hpp"
#include "layers/truncation.hpp"

namespace lamina::layers {

namespace {

/// A layer this many times as thick as the configuration is wide is a slip of the pen.
constexpr double thickest_layer = 1e4;
/// Heights below this many units of rounding of the coordinates cannot be represented.
constexpr double least_roundings = 64;
/// Rays added where counts of layers change find limits of their own, which may ask for more: once more at most.
constexpr int rounds_of_steps = 2;

void check_scale(const Box& box, const LayerGrowth& growth, const LayerHeights& heights) {
    const double extent = std::max(box.width(), box.height());
    const double largest =
        std::max({std::abs(box.lower.x), std::abs(box.lower.y), std::abs(box.upper.x), std::abs(box.upper.y)});
    if (!(growth.first_height > least_roundings * std::numeric_limits<double>::epsilon() * largest))
        throw OptionError("first_height", fmt::format("{} is below the resolution of coordinates as large as {}",
                                                      growth.first_height, largest));
    const double thickness = heights.max_height();
    if (!(thickness <= thickest_layer * extent))
        throw OptionError("layers", fmt::format("the layers asked for are {:.3g} thick, {:.3g} times the extent of the "
                                                "input",
                                                thickness, thickness / extent));
}

RaySet rays_of(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth) {
    RaySet set;
    for (const Element& element : geometry.elements) {
        const std::vector<RayLine> rays = make_rays(element.points, options, growth);
        set.lines.insert(set.lines.end(), rays.begin(), rays.end());
        set.begin.push_back(set.lines.size());
    }
    return set;
}

/// Returns origins without layers or directions: what is left of an element where no layer is wanted.
RaySet bare_walls(const Geometry& geometry) {
    RaySet set;
    for (const Element& element : geometry.elements) {
        for (Point p : element.points) set.lines.push_back({p, {}});
        set.begin.push_back(set.lines.size());
    }
    return set;
}

}  // namespace

bool take_rays(RaySet more, Rays& rays) {
    if (more.lines.size() == rays.set.lines.size()) return false;
    rays.set = std::move(more);
    rays.heights = make_heights(rays.set, rays.growth);
    rays.limits = height_limits(rays.set, rays.heights);
    return true;
}

void count_layers(Rays& rays) {
    rays.fitted = fit_heights(rays.heights, rays.limits);
    rays.counts = layer_counts(rays.set, rays.limits, rays.fitted);
}

std::vector<std::vector<FrontCorner>> front_corners(const LayeredRays& rays) {
    const auto& [set, heights, counts] = rays;
    std::vector<std::vector<FrontCorner>> fronts(set.elements());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t begin = set.begin[e], end = set.begin[e + 1];
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t next = i + 1 < end ? i + 1 : begin;
            const bool same = counts[i] == 0 && counts[next] == 0 && set.lines[i].origin == set.lines[next].origin;
            if (!same) fronts[e].push_back({i, counts[i]});
        }
    }
    return fronts;
}

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

Rays grow_rays(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth) {
    validate(options);
    Rays rays;
    rays.enabled = options.enabled;
    for (const Element& element : geometry.elements) rays.resampled.push_back(element.resampled);
    if (!options.enabled) {
        rays.set = bare_walls(geometry);
        rays.counts.assign(rays.set.lines.size(), 0);
        rays.fitted = LayerHeights({0.0}, std::vector<HeightColumn>(rays.set.lines.size()));
        return rays;
    }
    rays.growth = growth;
    rays.set = rays_of(geometry, options, rays.growth);
    rays.heights = make_heights(rays.set, rays.growth);
    check_scale(bounding_box(geometry), rays.growth, rays.heights);
    rays.limits = height_limits(rays.set, rays.heights);
    for (int round = 0; round < rounds_of_steps; ++round)
        if (!take_rays(add_rays_at_steps(rays.set, rays.heights, rays.limits), rays)) break;
    count_layers(rays);
    return rays;
}

Rays grow_rays(const Geometry& geometry, const LayerOptions& options) {
    validate(options);
    return grow_rays(geometry, options, layer_growth(options, bounding_box(geometry).width()));
}

std::vector<std::vector<Point>> fronts(const Rays& rays) {
    const LayeredRays layered{rays.set, rays.fitted, rays.counts};
    std::vector<std::vector<Point>> result;
    for (const std::vector<FrontCorner>& corners : front_corners(layered)) {
        std::vector<Point>& front = result.emplace_back();
        for (const FrontCorner& corner : corners) front.push_back(layered.tip(corner.ray));
    }
    return result;
}

}  // namespace lamina
