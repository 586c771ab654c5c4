// A wake leaves the layer between rays that are farther apart than its triangles should be wide:
//
//      |    |    |    |              |    |    |    |        Left: the wake divides the tops of high cells, and areas
//      |____|____|____|              |____|____|____|        differ by twice as much as without it. Right: sizes become
//      |_\/_|_\/_|_\/_|              |   / \  / \   /        smaller from the front on.
//       \/\/ \/\/ \/\/               |  /   \/   \ /
//
#include "pipeline/wake_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "layers/border/close_border.hpp"
#include "layers/layered_rays.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::pipeline {

namespace {

/// Tops are divided into parts of at least this share of the height of the cell below. Half of a cell that is as wide
/// as such a part has 1.8 times the area of an equilateral triangle beyond.
constexpr double least_share_of_height = 0.64;
/// A top has no more parts than are asked for if sizes are this many times as long as the parts: they are divided by it
/// where borders are (TargetLength), and so is their growth.
constexpr double size_over_part = layers::alike;
/// A top may have any number of parts beyond this.
constexpr double most_parts = 100;

/// A top of a last cell, and the size that wakes may ask for there at least.
struct CellTop {
    Point a, b;
    double least_size;
};

std::vector<CellTop> cell_tops(const layers::Rays& rays, std::size_t element) {
    const layers::LayeredRays layered = layers::layered_rays(rays);
    std::vector<CellTop> tops;
    const std::vector<layers::FrontCorner> corners = layers::front_corners(rays)[element];
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const layers::FrontCorner &corner = corners[k], &next = corners[(k + 1) % corners.size()];
        const Point a = layers::place_of(layered, corner), b = layers::place_of(layered, next);
        const double length = distance(a, b);
        const double least_part =
            least_share_of_height * std::min(layered.last_spacing(corner.ray), layered.last_spacing(next.ray));
        if (!(length < most_parts * least_part)) continue;
        const double parts = std::max(std::floor(length / least_part), 1.0);
        tops.push_back({a, b, size_over_part * length / parts});
    }
    return tops;
}

double distance_between(const SizeSource& source, const CellTop& top) {
    return std::min(
        {distance_to(source, top.a), distance_to(source, top.b), distance_to(source, midpoint(top.a, top.b))});
}

}  // namespace

void fit_wake_to_layer(const layers::Rays& rays, std::size_t element, double gradation, std::span<SizeSource> sources) {
    if (sources.empty() || !rays.enabled) return;
    const std::vector<CellTop> tops = cell_tops(rays, element);
    std::vector<Box> boxes;
    std::vector<double> values;  // negative, so that the tree finds the largest sizes
    for (const CellTop& top : tops) {
        boxes.push_back(core::bounding_box(top.a, top.b));
        values.push_back(-top.least_size);
    }
    const core::BoxTree tree(std::move(boxes));
    const auto minima = tree.group_minima(std::move(values));
    const double slope = gradation / size_over_part;
    for (SizeSource& source : sources) {
        double size = source.size;
        tree.below(bounding_box(source), slope, -source.size, minima, [&](std::size_t i) {
            size = std::max(size, tops[i].least_size - slope * distance_between(source, tops[i]));
        });
        source.size = size;
    }
}

}  // namespace lamina::pipeline
