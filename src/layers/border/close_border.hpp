// The front: the polygon through the tips of an element's rays. Once divided, it is the outer border of the layer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "layers/border/clefts.hpp"
#include "layers/border/divide_borders.hpp"
#include "layers/layer.hpp"
#include "layers/layered_rays.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// A corner of a front.
struct FrontCorner {
    std::size_t ray;       ///< the ray whose tip it is; of the rays of a fan that have no layers, the last one
    std::uint32_t layers;  ///< number of layers on that ray; 0: the corner is the ray's origin
    /// 0, or k: it is the k-th of the wall's vertices after that ray instead (RayLine::corner_after).
    std::size_t after = 0;
    std::optional<CleftEnd> cleft{};  ///< the end of the cleft that the edge behind this corner closes, if it does
};

/// Returns the corners of each element's front, which passes the ends of clefts by (clefts.hpp). The rays of a fan that
/// have no layers share one corner. A corner of the wall without a ray is one of the front's if neither ray beside it
/// has layers. The front of an outer wall ends with the wall beyond the domain.
std::vector<std::vector<FrontCorner>> front_corners(const Rays& rays);

/// Returns the number of an element's corners in the domain, which come first.
std::size_t corners_in_domain(const Rays& rays, std::size_t element, std::span<const FrontCorner> corners);

/// Returns the place of a front's corner.
Point place_of(const LayeredRays& rays, const FrontCorner& corner);

// Places the points of the layer.

/// Returns the layer of these rays: the points of walls, rays and borders, in this order, and the rays. Leaves
/// coverage, growth and edges empty. `corners` and `division` belong to the same fronts.
Layer build_layer(const Rays& rays, const std::vector<std::vector<FrontCorner>>& corners,
                  const BorderDivision& division);

}  // namespace lamina::layers
