// A solution decides first heights, the least thickness of layers, and spacings of walls.
#pragma once

#include <vector>

#include <lamina/pipeline.hpp>

#include "geometry/wall_spacing.hpp"
#include "layers/growth.hpp"

namespace lamina::pipeline {

/// Gives the growth of the layer the first heights and least heights that a background mesh has for the walls, in place
/// of those of the flow before the mesh, and returns the spacings that it asks for. Each of its walls belongs to the
/// element whose outline it follows; ground and tunnel walls follow none. First heights stay where options give them as
/// lengths.
std::vector<geometry::WallSpacing> guide_by_solution(const std::vector<SizedWall>& walls, const Geometry& geometry,
                                                     const LayerOptions& options, const ReferenceConditions& conditions,
                                                     layers::LayerGrowth& growth);

}  // namespace lamina::pipeline
