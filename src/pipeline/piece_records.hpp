// The records of pieces that processes send to rank 0, and the sums that rank 0 makes of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <lamina/mesh_sink.hpp>

#include "mesh/hash.hpp"
#include "pipeline/checked_pieces.hpp"
#include "pipeline/shared_pieces.hpp"

namespace lamina::pipeline {

/// Returns what rank 0 needs to know of the pieces of this process: sums over all of them where their order does not
/// matter, and a few numbers of each.
std::string pack_pieces(const HeldPieces& held);

/// All pieces together. Sums run in the order of the pieces, whoever has made them.
struct AllPieces {
    mesh::PieceFindings findings;  ///< as if they were one piece, but for its border
    PiecesSummary summary;
    mesh::HashOfParts hash;                             ///< of their triangles
    MeshCounts counts;                                  ///< of the mesh, with its layer
    std::vector<std::vector<PieceNumbers>> numbers_of;  ///< for each rank: of its pieces, in its order

    explicit AllPieces(double min_angle_deg) : findings(min_angle_deg) {}
};

/// Adds up what pack_pieces() returns on all ranks. The pieces are numbered behind the vertices and triangles of
/// `before`. Throws MeshError unless each piece was made once.
AllPieces add_up(const std::vector<std::string>& of_ranks, std::size_t pieces, const MeshCounts& before,
                 double min_angle_deg);

}  // namespace lamina::pipeline
