// Two triangles of a cell with a divided top, joined to a quadrilateral.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::layers {

/// Joins the triangle on the edge between `a` and `d` with one beside it, if they make a strictly convex quadrilateral
/// and no face inside the cell is farther from orthogonal to the line between the centroids on both sides then. Of the
/// two beside it, the one is taken with which the worst face is better; where they are equal, `first_leads` prefers the
/// one before. Removes both triangles, and returns the quadrilateral, whose corners begin at `a`.
/// Precondition: `triangles` from `begin` on are a strip (StripCutter::cut()), and one of them has both corners.
std::optional<Quad> join_on_lower_edge(std::span<const Point> points, VertexId a, VertexId d, bool first_leads,
                                       std::size_t begin, std::vector<Triangle>& triangles);

}  // namespace lamina::layers
