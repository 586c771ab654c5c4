// Rings of trapezoids between the near-body box and the far field: the first subdomains.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "decoupling/skeleton.hpp"

namespace lamina::decoupling {

/// The boxes between which rings lie.
struct RingBoxes {
    Box near_body, outermost;

    /// Returns the box at a parameter from 0, the near-body box, to 1, the outermost box.
    Box at(double t) const {
        return {near_body.lower + t * (outermost.lower - near_body.lower),
                near_body.upper + t * (outermost.upper - near_body.upper)};
    }
};

/// A ring between the boxes at two parameters.
struct Ring {
    double inner, outer;   ///< parameters of RingBoxes::at()
    std::size_t per_side;  ///< number of trapezoids on each of its four sides
};

/// Returns rings from the near-body box to the outermost box, in which no trapezoid has more than about `pieces_target`
/// triangles. Trapezoids are halved along their longer extent, measured in edge lengths. Numbers per side are powers of
/// two, so that neighbouring rings share junctions. There is no ring where the near-body box is the outermost one.
std::vector<Ring> plan_rings(const RingBoxes& boxes, const SizeField& size, double pieces_target);

/// Adds near-body box, rings and outermost box to the skeleton. Their lines are not divided yet. The first ones are
/// those along the boxes: each begins at the next junction. Returns the lines along the outermost box, with the region
/// on their left. Where a region lies beyond it, it is on their right.
std::vector<std::uint32_t> add_rings(Skeleton& skeleton, std::span<const Ring> rings, const RingBoxes& boxes,
                                     bool region_beyond);

}  // namespace lamina::decoupling
