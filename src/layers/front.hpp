// The front: the polygon through the tips of an element's rays. Once divided, it is the outer border of the layer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "layers/layered_rays.hpp"

namespace lamina::layers {

/// A corner of a front.
struct FrontCorner {
    std::size_t ray;       ///< the ray whose tip it is; of the rays of a fan that have no layers, the last one
    std::uint32_t layers;  ///< number of layers on that ray; 0: the corner is the ray's origin
};

/// Returns the corners of each element's front. The rays of a fan that have no layers share one corner.
std::vector<std::vector<FrontCorner>> front_corners(const LayeredRays& rays);

}  // namespace lamina::layers
