// Cells with divided tops: diagonals turned, and two triangles joined to a quadrilateral.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::layers {

/// A side of a cell, which lies on a ray, and the centroid of the cell beyond it.
struct CellSide {
    VertexId lower, upper;
    Point beyond;
};

/// Turns one diagonal of a cell where its side is too skewed, if neither the side nor any face inside the cell is as
/// bad then. `lower` is the lower chain of the strip, the side one edge of that, and `edge` another one, with which
/// join_on_lower_edge() is going to join triangles. Of turns that are equally good, `first_leads` prefers the first.
/// Precondition: `triangles` from `begin` on are a strip (StripCutter::cut()).
void turn_from_side(std::span<const Point> points, std::span<const VertexId> lower, const std::array<VertexId, 2>& edge,
                    const CellSide& side, bool first_leads, std::size_t begin, std::vector<Triangle>& triangles);

/// Joins the triangle on the edge between `a` and `d` with one beside it, if they make a strictly convex quadrilateral
/// and no face inside the cell is farther from orthogonal to the line between the centroids on both sides then. Of the
/// two beside it, the one is taken with which the worst face is better; where they are equal, `first_leads` prefers the
/// one before. Removes both triangles, and returns the quadrilateral, whose corners begin at `a`.
/// Precondition: `triangles` from `begin` on are a strip (StripCutter::cut()), and one of them has both corners.
std::optional<Quad> join_on_lower_edge(std::span<const Point> points, VertexId a, VertexId d, bool first_leads,
                                       std::size_t begin, std::vector<Triangle>& triangles);

}  // namespace lamina::layers
