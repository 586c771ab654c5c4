// Origins on an edge, and directions at even angles from its normal.
#include "layers/intermediate_rays.hpp"

#include "core/angles.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

IntermediateRays::IntermediateRays(const RayLine& first, const RayLine& last)
    : from_(first.origin),
      to_(last.origin),
      normal_(-perpendicular(unit(to_ - from_))),
      first_least_height_(first.least_height),
      last_least_height_(last.least_height) {
    // Rays stay within 90 degrees of the edge's normal, so that the difference of the two angles needs no wrapping.
    first_angle_ = core::angle_between(normal_, first.direction);
    last_angle_ = core::angle_between(normal_, last.direction);
}

void IntermediateRays::add(double part, double whole, std::vector<RayLine>& rays) const {
    const double rest = whole - part;
    const Point origin{(rest * from_.x + part * to_.x) / whole, (rest * from_.y + part * to_.y) / whole};
    if (origin == rays.back().origin || origin == to_ || origin == from_) return;
    rays.push_back({.origin = origin,
                    .direction = unit(core::rotated(normal_, (rest * first_angle_ + part * last_angle_) / whole)),
                    .least_height = (rest * first_least_height_ + part * last_least_height_) / whole});
}

}  // namespace lamina::layers
