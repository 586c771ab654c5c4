// Even columns: rays turn towards the wider one of the columns on both sides.
#pragma once

#include <span>
#include <vector>

#include "layers/normal_smoothing.hpp"
#include "layers/wake_outline.hpp"

namespace lamina::layers {

/// Adds to the tilts of the vertices, so that neighbouring columns are nearly as wide as each other at `heights`, those of the
/// front, one per vertex: over many columns on jagged outlines, over few on others. No ray leans so far that its first
/// height could not be kept above the edges on both sides, unless it did before. The rays of fans stay, and those of smooth
/// outlines that lean far already.
void even_columns(std::span<const RayVertex> outline, OutlineKind kind, std::span<const double> heights,
                  const LayerGrowth& growth, std::vector<WallVertex>& vertices);

}  // namespace lamina::layers
