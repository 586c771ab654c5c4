// Divisions of edges taken back where rounding makes them cross something.
#pragma once

#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "layers/polygon_edges.hpp"

namespace lamina::layers {

/// Removes the division points of edges whose parts meet or fold onto other parts or walls. Division points lie on
/// their edge only to rounding, so this happens where a front nearly touches a wall or another front. points: the
/// division points of each edge, in order. Precondition: the edges themselves meet each other and the walls in common
/// vertices and whole common edges only.
void undo_crossings(std::span<const PolygonEdge> edges, std::span<const PolygonEdge> walls,
                    std::vector<std::vector<Point>>& points);

}  // namespace lamina::layers
