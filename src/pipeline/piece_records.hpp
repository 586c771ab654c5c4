// The records of pieces that processes send to rank 0, and what becomes of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/mesh_sink.hpp>

#include "mesh/hash.hpp"
#include "pipeline/checked_pieces.hpp"
#include "pipeline/shared_pieces.hpp"

namespace lamina::pipeline {

/// Returns what rank 0 needs to know of all pieces of this process together.
std::string pack_pieces(const HeldPieces& held);
/// Returns what pack_pieces() would return for the pieces of both records.
std::string join_records(std::string_view one, std::string_view other);

/// All pieces together. No sum depends on the order in which they were added.
struct AllPieces {
    mesh::PieceFindings findings;  ///< as if they were one piece, but for its border
    PiecesSummary summary;
    mesh::HashOfParts hash;  ///< of their triangles

    explicit AllPieces(double min_angle_deg) : findings(min_angle_deg) {}
};

/// These numbers say where all pieces of a mesh begin, whoever has made them.
struct NumberedPieces {
    std::vector<PieceNumbers> numbers;               ///< by the numbers of the pieces
    std::vector<std::vector<std::size_t>> of_ranks;  ///< for each rank: its pieces, in its order
    MeshCounts counts;                               ///< of the mesh, with its layer
};

/// Returns the sizes of the pieces of this process for number_pieces().
std::string pack_sizes(const HeldPieces& held);
/// Numbers so many pieces in their order, behind the vertices and triangles of `before`, from what pack_sizes() returns on
/// all ranks. Throws MeshError unless each piece was made once.
NumberedPieces number_pieces(std::span<const std::string> of_ranks, std::size_t pieces, const MeshCounts& before);

/// Adds up all pieces, from the joined records of all ranks.
AllPieces add_up(std::string_view record, std::span<const PieceNumbers> numbers, double min_angle_deg);

}  // namespace lamina::pipeline
