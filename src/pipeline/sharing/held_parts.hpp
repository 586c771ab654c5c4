// The parts of a shared mesh that this process holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <lamina/mesh_sink.hpp>

#include "core/connected_ranks.hpp"
#include "layers/layer.hpp"
#include "mesh/shared_parts.hpp"
#include "pipeline/sharing/piece_store.hpp"
#include "pipeline/sharing/shared_pieces.hpp"

namespace lamina::pipeline {

/// The pieces that a process holds, and where they belong.
struct HeldNumbers {
    std::unique_ptr<PieceStore> store;
    std::vector<std::size_t> pieces;    ///< ascending
    std::vector<std::size_t> places;    ///< of each of them in the store
    std::vector<PieceNumbers> numbers;  ///< of each of them
    std::size_t layer_pieces = 0;       ///< pieces of the layer, which are numbered before those of the subdomains
};

class HeldParts : public mesh::MeshParts {
public:
    /// Each process has a share of the vertices of the decoupling. Rank 0 holds the layer, too.
    HeldParts(std::unique_ptr<SharedDecoupling> shared, layers::LayerCells cells, HeldNumbers held,
              const MeshCounts& counts, const core::ConnectedRanks& ranks);

    std::vector<std::uint64_t> places() const override;
    void visit(std::size_t i, const std::function<void(const MeshPart&)>& take) const override;
    mesh::PartCounts counts(std::size_t i) const override;

private:
    std::unique_ptr<SharedDecoupling> shared_;  ///< its lines are divided when their vertices are visited
    layers::LayerCells cells_;
    HeldNumbers held_;
    std::vector<MeshPart> points_;          ///< all parts of the vertices of the decoupling
    std::vector<std::size_t> own_points_;   ///< the numbers of those of this process
    std::vector<MeshPart> layer_, behind_;  ///< the other parts before those of the subdomains, and those behind them
};

}  // namespace lamina::pipeline
