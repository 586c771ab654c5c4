// Rays that lean out of corners keep the first height above both edges.
#pragma once

#include <span>

#include <lamina/layers.hpp>

#include "layers/outline_kind.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// Sets the shifts of rays at corners (RayLine::shift), where there is room: those of the one ray of a vertex whose first
/// layer would be higher above one of the edges there than above the other, or higher above both than it may be
/// (max_slant). On outlines that are not jagged, only at corners that turn by more than 6 degrees. jagged: one
/// per element.
void shift_rays_of_corners(std::span<const char> jagged, const LayerGrowth& growth, RaySet& set);

/// Returns the largest lean of the one ray of a vertex, in radians, at which its first layer needs no shift or, on jagged
/// outlines, has room for it. `turning` is that of the vertex, in radians; shorter_edge: length of the shorter one of its
/// edges.
double max_lean_between_edges(double turning, OutlineKind kind, double first_height, double shorter_edge);

}  // namespace lamina::layers
