// The outer border cut into the stretches between the tips of neighbouring rays.
#include "layers/cell_columns.hpp"

#include <algorithm>

namespace lamina::layers {

CellColumns::CellColumns(const Layer& layer, std::size_t element)
    : rays_(layer.rays[element]), border_(layer.borders[element]) {
    border_.push_back(border_.front());
    for (const LayerCleft& cleft : layer.clefts) {
        if (cleft.element != element) continue;
        const auto outer_edge = std::find(border_.begin(), border_.end(), cleft.outer_edge.front()) + 1;
        const auto inner_points = static_cast<std::ptrdiff_t>(cleft.outer_edge.size()) - 2;
        const auto at = border_.erase(outer_edge, outer_edge + inner_points);
        std::vector<VertexId> tips;
        for (std::size_t i = cleft.first + 1; i < cleft.last; ++i) tips.push_back(rays_[i].tip());
        border_.insert(at, tips.begin(), tips.end());
    }
    // The border visits the tips in the order of the rays; rays of one origin without layers have one tip.
    std::size_t at = 0;
    tip_.reserve(rays_.size() + 1);
    for (const Ray& ray : rays_) {
        while (border_[at] != ray.tip()) ++at;
        tip_.push_back(at);
    }
    tip_.push_back(border_.size() - 1);
}

CellColumn CellColumns::operator[](std::size_t i) const {
    const std::size_t n = size(), before = (i + n - 1) % n, second = (i + 1) % n, after = (i + 2) % n;
    CellColumn column{rays_[i], rays_[second], border_between_tips(i), {}, {}, rays_[before], rays_[after]};
    if (border_runs_along(before, i)) column.up = border_between_tips(before);
    if (border_runs_along(after, second)) column.down = border_between_tips(second);
    return column;
}

/// Returns the stretch of the border from the tip of ray i to that of the next one, both included.
std::span<const VertexId> CellColumns::border_between_tips(std::size_t i) const {
    return {border_.data() + tip_[i], border_.data() + tip_[i + 1] + 1};
}

/// Returns whether, of two neighbours with one origin, `bare` has no layers and `ray` has one. The border between their
/// tips then is the lowest piece of `ray`.
bool CellColumns::border_runs_along(std::size_t bare, std::size_t ray) const {
    return rays_[bare].layers == 0 && rays_[ray].layers == 1 && rays_[bare].origin == rays_[ray].origin;
}

}  // namespace lamina::layers
