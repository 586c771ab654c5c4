// The ends of clefts, where fronts are so near to each other that nothing but one strip of triangles fits between them.
#pragma once

#include <cstddef>
#include <vector>

#include "layers/layered_rays.hpp"

namespace lamina::layers {

/// The end of a cleft. The rays from `first` to `last` stand round it, and the front goes from the tip of `first` to
/// that of `last`.
struct CleftEnd {
    std::size_t corner;       ///< the ray before the sharp corner of the wall (RayLine::corner_after)
    std::size_t first, last;  ///< the outermost rays
};

/// Returns the ends of clefts that begin at sharp corners of the wall and in which the fronts on both sides are nearer
/// to each other than their edges are long, in the order of the rays. Each can be cut into positive triangles between
/// both fronts, and no other front enters it.
std::vector<CleftEnd> cleft_ends(const LayeredRays& rays);

}  // namespace lamina::layers
