// Pieces of the plane between straight lines, and what a cut makes of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::decoupling {

/// A region by the vertices round it, the region on the left of every loop: the outer loop first, then its holes. A
/// loop runs along both sides of an edge that dangles in the region, and has its vertices twice.
struct Piece {
    std::vector<std::vector<VertexId>> loops;
};

/// A place in a loop of a piece.
struct Corner {
    std::size_t loop, place;
    friend bool operator==(const Corner&, const Corner&) = default;
};

/// Pieces left of the directed edges, which meet at end points only. An edge with a piece on both sides stands in both
/// directions. Loops that lie inside a piece without touching its outer loop become holes of that piece; the unbounded
/// region is left out. Pieces are ordered by their lowest-numbered edge in `edges`. O(n log n), plus holes x pieces.
std::vector<Piece> trace_pieces(std::span<const Point> points, std::span<const Segment> edges);

/// The pieces that a line between two corners of the only loop makes; `line` are the vertices inside it.
///
///       o------ to -----o
///       |        :      |        the first piece has the line in its direction, the second one against it
///       | first  : second
///       |        :      |
///       o----- from ----o
struct Halves {
    Piece first, second;
};
Halves split(const Piece& piece, std::size_t from, std::size_t to, std::span<const VertexId> line);

/// The piece with two of its loops joined by a line between them: the new loop runs along both sides of the line.
///
///       o----------------o
///       |          o---o |
///       to :::: from   | |        one hole less
///       |          o---o |
///       o----------------o
Piece join(const Piece& piece, Corner from, Corner to, std::span<const VertexId> line);

}  // namespace lamina::decoupling
