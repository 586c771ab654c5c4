// Fewer rays in fans that end low.
#pragma once

#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns the rays without some of those inside fans that are cut short, where columns of the fan would be far narrower
/// at the front than the columns beside it: on jagged elements (Rays::jagged), whose neighbouring rays may differ by
/// max_low_fan_angle_deg there. The first and the last ray of a fan stay.
RaySet leave_out_rays_of_low_fans(const Rays& rays);

}  // namespace lamina::layers
