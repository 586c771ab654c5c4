// Delaunay triangulation of points or of a region in pieces.
#pragma once

#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/triangulation.hpp>

#include "core/busy_times.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::delaunay::pieces {

/// The triangles of all pieces, piece by piece in the order of the decomposition.
struct PiecewiseTriangulation {
    std::vector<Triangle> triangles;
    std::vector<std::size_t> first;  ///< the first triangle of each piece, and the number of triangles
    DecompositionStats stats;
};

/// Returns the Delaunay triangulation of the points, piece by piece. `times`, if given, measures the kinds of
/// PieceWork. Throws as triangulate() does.
LAMINA_EXPORT PiecewiseTriangulation triangulate_in_pieces(std::span<const Point> points,
                                                           const DecompositionOptions& options,
                                                           core::BusyTimes* times = nullptr);

/// Returns the constrained Delaunay triangulation of the region on the left of its border, piece by piece: the
/// triangles that triangulate() keeps with KeptRegion::left_of_segments. Throws as triangulate() does. Precondition:
/// the border bounds the region all round, and every point lies in the region or on its border.
LAMINA_EXPORT PiecewiseTriangulation triangulate_in_pieces(std::span<const Point> points,
                                                           std::span<const Segment> border,
                                                           const DecompositionOptions& options,
                                                           core::BusyTimes* times = nullptr);

}  // namespace lamina::delaunay::pieces
