// What lies between walls and outer borders: its triangulation, and its edges as the other stages need them.
#pragma once

#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/layers.hpp>

namespace lamina {

/// Edges of walls and outer borders, sorted out: an edge that both have bounds no layer.
struct LayerEdges {
    std::vector<std::vector<Segment>> walls;  ///< per element, the mesh on their left (clockwise round the body)
    std::vector<Segment> region;              ///< those that bound the layer, the layer on their left
    std::vector<Segment>
        interfaces;  ///< outer-border edges between layer and outer region, smaller vertex first, sorted
};
LayerEdges layer_edges(const Layer& layer);

/// Constrained Delaunay triangles of the layer's points between walls and outer borders.
std::vector<Triangle> triangulate_layer(const Layer& layer, const LayerEdges& edges);

}  // namespace lamina
