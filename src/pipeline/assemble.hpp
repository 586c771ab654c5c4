// Assembly: pieces into one mesh, without any search by coordinates.
#pragma once

#include <span>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>
#include <lamina/mesh.hpp>

#include "pipeline/layer_region.hpp"

namespace lamina {

/// Numbers border vertices as the decoupling did (walls, layer, separators) and the vertices added inside pieces by an
/// exclusive scan over the pieces in their order. Layer triangles come first, then those of the pieces in their order,
/// then the layer's quads. Pieces are numbered
/// layer first. Consumes the pieces.
Mesh assemble(const Pslg& pslg, const LayerEdges& edges, LayerFill layer_fill, Decoupling decoupling,
              std::vector<Refinement> pieces);

}  // namespace lamina
