// A solution decides first heights, the least thickness of layers, and spacings of walls.
#pragma once

#include <vector>

#include <lamina/pipeline.hpp>

#include "layers/growth.hpp"
#include "pipeline/flow_guidance.hpp"

namespace lamina::pipeline {

/// Gives the growth of the layer the first heights and least heights that a background mesh has for the walls, and `guidance` the
/// spacings that it asks for, in place of those of the flow before the mesh. Each of its walls belongs to the element that is
/// nearest to its first point. First heights stay where options give them as lengths.
void guide_by_solution(const std::vector<SizedWall>& walls, const Geometry& geometry, const LayerOptions& options,
                       const ReferenceConditions& conditions, FlowGuidance& guidance, layers::LayerGrowth& growth);

}  // namespace lamina::pipeline
