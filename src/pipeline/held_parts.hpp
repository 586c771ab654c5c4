// The parts of a shared mesh that this process holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/layers.hpp>
#include <lamina/mesh_sink.hpp>

#include "pipeline/piece_store.hpp"
#include "pipeline/shared_pieces.hpp"

namespace lamina::pipeline {

/// The pieces that a process holds, and where they belong.
struct HeldNumbers {
    std::unique_ptr<PieceStore> store;
    std::vector<std::size_t> pieces;    ///< ascending
    std::vector<PieceNumbers> numbers;  ///< of each of them
    std::size_t layer_pieces = 0;       ///< pieces of the layer, which are numbered before those of the subdomains
};

class HeldParts : public MeshParts {
public:
    /// Rank 0 holds what no subdomain has, too.
    HeldParts(Decoupling decoupling, LayerCells cells, HeldNumbers held, const MeshCounts& counts, bool has_layer);

    std::vector<std::uint64_t> places() const override;
    void visit(std::size_t i, const std::function<void(const MeshPart&)>& take) const override;

private:
    Decoupling decoupling_;
    LayerCells cells_;
    HeldNumbers held_;
    std::vector<MeshPart> before_, behind_;  ///< the parts before those of the subdomains, and those behind them
};

}  // namespace lamina::pipeline
