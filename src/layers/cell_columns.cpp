// The outer border cut into the stretches between the tips of neighbouring rays.
#include "layers/cell_columns.hpp"

namespace lamina::layers {

CellColumns::CellColumns(std::span<const Ray> rays, std::span<const VertexId> border)
    : rays_(rays), border_(border.begin(), border.end()) {
    border_.push_back(border_.front());
    // The border visits the tips in the order of the rays; rays of one origin without layers have one tip.
    std::size_t at = 0;
    tip_.reserve(rays.size() + 1);
    for (const Ray& ray : rays) {
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
