// Pieces cut by straight, graded lines until each holds about the number of triangles asked for.
#pragma once

#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/sizing.hpp>

#include "decoupling/piece.hpp"
#include "decoupling/skeleton.hpp"

namespace lamina::decoupling {

struct SizedPiece {
    Piece piece;
    double triangles;  ///< estimated
    bool lattice;      ///< whether a lattice may pay in it
};

/// Cuts every piece of more than about 1.5 x `pieces_target` triangles in two, and the halves again, by lines between
/// vertices of its border. A line is drawn only where it leaves either border at 60 degrees or more, is no shorter than
/// four segments, meets segments like its own, and neither has a vertex of the piece in a diametral circle nor is in
/// one of the piece's: where there is no such line the piece stays whole. Holes are joined to the piece's outer border
/// first. New vertices are added to skeleton.points; what comes out does not depend on the number of threads.
std::vector<SizedPiece> cut_to_size(Skeleton& skeleton, std::vector<Piece> pieces, const Separation& separation,
                                    double pieces_target);

}  // namespace lamina::decoupling
