// The lengths that edges of fronts request of their surroundings: their own, or the width of a gap that they face.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/box_tree.hpp"
#include "layers/polygon_edges.hpp"

namespace lamina::layers {

/// Adds the sources of one edge, in order from its start to its end. A gap counts where it is: the edge is halved until
/// its parts are no longer than the gap that they face. A part requests the width of the gap, or `requested_length` if
/// that is less. tree: the tree over the edges.
void add_edge_sources(std::span<const PolygonEdge> edges, const core::BoxTree& tree, std::size_t edge,
                      double requested_length, std::vector<SizeSource>& sources);

}  // namespace lamina::layers
