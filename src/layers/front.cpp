// The corners of fronts, and the fronts as points.
#include "layers/front.hpp"

#include "layers/stages.hpp"

namespace lamina::layers {

std::vector<std::vector<FrontCorner>> front_corners(const LayeredRays& rays) {
    const auto& [set, heights, counts] = rays;
    std::vector<std::vector<FrontCorner>> fronts(set.elements());
    const std::vector<CleftEnd> clefts = cleft_ends(rays);
    std::size_t cleft = 0;  // the next one
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t begin = set.begin[e], end = set.begin[e + 1];
        for (std::size_t i = begin; i < end; ++i) {
            if (cleft < clefts.size() && i == clefts[cleft].first) {
                fronts[e].push_back({i, counts[i], 0, clefts[cleft]});
                i = clefts[cleft++].last - 1;
                continue;
            }
            const std::size_t next = i + 1 < end ? i + 1 : begin;
            const bool one_corner =
                counts[i] == 0 && counts[next] == 0 && set.lines[i].origin == set.lines[next].origin;
            if (!one_corner) fronts[e].push_back({i, counts[i]});
            if (counts[i] > 0 || counts[next] > 0) continue;
            for (std::size_t k = 1; k <= set.lines[i].corner_after.size(); ++k) fronts[e].push_back({i, 0, k});
        }
    }
    return fronts;
}

Point place_of(const LayeredRays& rays, const FrontCorner& corner) {
    return corner.after > 0 ? rays.set.lines[corner.ray].corner_after[corner.after - 1] : rays.tip(corner.ray);
}

std::vector<std::vector<Point>> fronts(const Rays& rays) {
    const LayeredRays layered = layered_rays(rays);
    std::vector<std::vector<Point>> result;
    for (const std::vector<FrontCorner>& corners : front_corners(layered)) {
        std::vector<Point>& front = result.emplace_back();
        front.reserve(corners.size());
        for (const FrontCorner& corner : corners) front.push_back(place_of(layered, corner));
    }
    return result;
}

}  // namespace lamina::layers
