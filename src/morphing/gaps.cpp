#include "morphing/gaps.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"

namespace lamina::morphing {

namespace {

/// Rays look as many times as far as they are high: what is farther away would have a weight of 0.012 at most.
constexpr double sight = 20;

/// Returns the weight of a gap of which two opposite layers take this share: it has no kink.
double weight_of(double share) { return share * share / (share * share + (1 - share) * (1 - share)); }

}  // namespace

std::vector<Gap> find_gaps(std::span<const Point> wall, std::span<const Segment> edges, std::span<const Point> tips) {
    std::vector<Box> boxes;
    for (const auto& [a, b] : edges) boxes.push_back(core::bounding_box(wall[a.index()], wall[b.index()]));
    const core::BoxTree tree(std::move(boxes));
    std::vector<Gap> gaps(wall.size());
    for (std::size_t v = 0; v < wall.size(); ++v) {
        const Point ray = tips[v] - wall[v], end = wall[v] + sight * ray;
        if (ray == Point{}) continue;
        double nearest = sight;  // in heights of the ray
        tree.overlaps(core::bounding_box(wall[v], end), [&](std::size_t e) {
            const Segment edge = edges[e];
            if (edge.a.index() == v || edge.b.index() == v) return;
            const Point to_a = wall[edge.a.index()] - wall[v], along = wall[edge.b.index()] - wall[edge.a.index()];
            const double turned = cross(ray, along);
            if (turned == 0) return;
            const double height = cross(to_a, along) / turned, share = cross(to_a, ray) / turned;
            if (height <= 0 || height >= nearest || share < 0 || share > 1) return;
            nearest = height;
            gaps[v] = {.across = edge,
                       .share = share,
                       .length = height * length(ray),
                       .weight = weight_of(std::min(1.0, 2 / height))};
        });
        // The length as it is measured later: walls that stay change nothing, not even by rounding.
        if (gaps[v].weight > 0) gaps[v].length = length(gaps[v].vector_from(v, wall));
    }
    return gaps;
}

}  // namespace lamina::morphing
