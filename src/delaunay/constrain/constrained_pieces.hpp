// Constrained triangulation in pieces, on all threads.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/triangulation.hpp>

#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// A triangulation of the convex hull with the pieces of segments that it holds as constrained edges.
struct TriangulatedPieces {
    Tris tris;                         ///< closed by ghosts; empty where all points lie on one line
    std::vector<Index> at_vertex;      ///< one triangle at each vertex
    std::vector<SegmentPiece> pieces;  ///< in the order of the segments, each chain from a to b
    DecompositionStats stats{};
};

/// A constrained triangulation that was tried in pieces, or the reason why there is none.
struct PiecesTrial {
    std::optional<TriangulatedPieces> triangulated;
    bool crossed = false;  ///< whether there is none because segments cross
};

/// Makes the constrained triangulation of points and segments that insert_and_split_segments() makes, but for the order
/// of triangles, which depends on the options and not on the number of threads. Without options small sets stay in one
/// piece. There is no result where there is one piece alone, where segments cross, and where points or segments are not
/// as they should be: to say what is wrong is left to the triangulation of all points at once.
/// Segments inside a piece are inserted there; those that meet its border follow one by one.
PiecesTrial triangulate_in_pieces(std::span<const Point> points, std::span<const Segment> segments,
                                  const std::optional<DecompositionOptions>& options);

}  // namespace lamina::delaunay
