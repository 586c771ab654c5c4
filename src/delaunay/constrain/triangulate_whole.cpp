// triangulate() without a decomposition, for the amalgamation (tools/amalgamate.py): on one thread pieces do not pay.
// The library has pieces/pieces.cpp and pieces/constrained_pieces.cpp instead.
#include <lamina/triangulation.hpp>

#include "delaunay/constrain/constrained_pieces.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay {

PiecesTrial triangulate_in_pieces(std::span<const Point>, std::span<const Segment>,
                                  const std::optional<DecompositionOptions>&) {
    return {};
}

}  // namespace lamina::delaunay

namespace lamina {

Triangulation triangulate(std::span<const Point> points) {
    Triangulation result = delaunay::without_ghosts(delaunay::triangulate_points(points));
    result.decomposition = {.pieces = 1, .piece_vertices = points.size(), .largest_piece = points.size()};
    return result;
}

Triangulation triangulate(std::span<const Point> points, const DecompositionOptions&) { return triangulate(points); }

}  // namespace lamina
