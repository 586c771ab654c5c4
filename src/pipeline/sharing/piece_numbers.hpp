// The numbers of the first vertex and triangle of each piece of a mesh, which all processes find out together.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/mesh_sink.hpp>

#include "core/connected_ranks.hpp"
#include "pipeline/sharing/shared_pieces.hpp"

namespace lamina::pipeline {

/// The numbers of the pieces that a process holds, and the counts of the whole mesh with its layer.
struct NumberedPieces {
    std::vector<PieceNumbers> numbers;  ///< one per held piece: those of its first inner vertex and triangle
    MeshCounts counts;
};

/// Collective: numbers so many pieces in their order, behind the vertices and triangles of `before`, which is that of
/// rank 0. Each process adds up the sizes of successive pieces, and rank 0 those of the processes. Throws MeshError
/// unless each piece was made once.
NumberedPieces number_pieces(const HeldPieces& held, std::size_t pieces, const MeshCounts& before,
                             core::ConnectedRanks& ranks);

}  // namespace lamina::pipeline
