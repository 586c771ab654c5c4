// What lies between walls and outer borders: its triangulation, and its edges as the other stages need them.
#pragma once

#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/layers.hpp>

#include "decomposition/pieces.hpp"
#include "layers/connect.hpp"

namespace lamina {

/// Edges of walls and outer borders, sorted out: an edge that both have bounds no layer.
struct LayerEdges {
    std::vector<std::vector<Segment>> walls;  ///< per element, the mesh on their left (clockwise round the body)
    std::vector<Segment> region;              ///< those that bound the layer, the layer on their left
    std::vector<Segment>
        interfaces;  ///< outer-border edges between layer and outer region, smaller vertex first, sorted
};
LayerEdges layer_edges(const Layer& layer);

/// The cells between walls and outer borders, piece by piece.
struct LayerFill {
    LayerCells cells;
    std::vector<std::size_t> first_triangle;  ///< of each piece, and the end; empty where there is no layer
    DecompositionStats decomposition;         ///< of Delaunay layers

    std::size_t pieces() const { return first_triangle.empty() ? 0 : first_triangle.size() - 1; }
};

/// In the topology asked for; only that of triangles is made in several pieces.
LayerFill fill_layer(const Layer& layer, const LayerEdges& edges, LayerTopology topology,
                     const DecompositionOptions& options = {}, BusyTimes* times = nullptr);

/// Constrained Delaunay triangles of the layer's points between walls and outer borders, in pieces.
decomposition::PiecewiseTriangulation triangulate_layer(const Layer& layer, const LayerEdges& edges,
                                                        const DecompositionOptions& options = {},
                                                        BusyTimes* times = nullptr);

}  // namespace lamina
