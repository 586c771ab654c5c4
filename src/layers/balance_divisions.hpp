// Divisions of neighbouring edges balanced against each other.
#pragma once

#include <span>
#include <vector>

#include "layers/edge_division.hpp"
#include "layers/polygon_edges.hpp"

namespace lamina::layers {

/// Shifts division points and adds parts until the lengths of the parts on both sides of each corner differ by no more
/// than max_ratio, except where an edge may get no more parts. One division per edge. All corners are judged by one
/// state and then changed together, so that the result depends neither on where a polygon starts nor on its direction.
void balance_divisions(std::span<const PolygonEdge> edges, double max_ratio, std::vector<EdgeDivision>& divisions);

}  // namespace lamina::layers
