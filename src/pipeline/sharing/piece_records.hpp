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
#include "pipeline/sharing/checked_pieces.hpp"
#include "pipeline/sharing/shared_pieces.hpp"

namespace lamina::pipeline {

/// Returns what rank 0 needs to know of all pieces of this process together, which begin at these numbers.
std::string pack_pieces(const HeldPieces& held, std::span<const PieceNumbers> numbers);
/// Returns what pack_pieces() would return for the pieces of both records.
std::string join_records(std::string_view one, std::string_view other);

/// All pieces together. No sum depends on the order in which they were added.
struct AllPieces {
    mesh::PieceFindings findings;  ///< as if they were one piece, but for its border
    PiecesSummary summary;
    mesh::HashOfParts hash;  ///< of their triangles

    explicit AllPieces(double min_angle_deg) : findings(min_angle_deg) {}
};

/// Adds up all pieces, from the joined records of all ranks.
AllPieces add_up(std::string_view record, double min_angle_deg);

}  // namespace lamina::pipeline
