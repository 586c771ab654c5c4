// Cuts of pieces along dividing paths.
#pragma once

#include <optional>

#include <lamina/triangulation.hpp>

#include "delaunay/pieces/piece.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::delaunay::pieces {

/// The two parts of a piece that was cut; `low` has the lower coordinates.
struct PieceHalves {
    Piece low, high;
};

/// Cuts a piece along the first good dividing path of several that are tried in a fixed order. A path is good if it
/// crosses no edge of the piece's border and leaves neither part with more than 0.75 of the points. Returns nothing
/// where no path is good. The low part takes over the storage of the piece. Counts rejected cuts in `stats`. O(points).
/// Source: thesis 4.2-4.5, 6.3, 6.7.
std::optional<PieceHalves> cut_piece(const SortedPoints& sorted, Piece& piece, DecompositionStats& stats);

/// Returns whether a piece is not cut further: because it is small or deep enough, or has no points inside.
bool is_leaf(const Piece& piece, const DecompositionOptions& options);

}  // namespace lamina::delaunay::pieces
