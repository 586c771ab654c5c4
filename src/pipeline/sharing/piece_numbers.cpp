#include "pipeline/sharing/piece_numbers.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/packing.hpp"
#include "pipeline/sharing/parts.hpp"

namespace lamina::pipeline {

namespace {

using core::Packer;
using core::Unpacker;

std::vector<std::string> take_all(std::vector<Packer>& packers) {
    std::vector<std::string> texts;
    texts.reserve(packers.size());
    for (Packer& packer : packers) texts.push_back(packer.take());
    return texts;
}

/// Successive pieces whose sizes a process adds up.
class PieceBlock {
public:
    PieceBlock(std::size_t pieces, const core::ConnectedRanks& ranks)
        : size_(std::max<std::size_t>(1, (pieces + ranks.size() - 1) / ranks.size())),
          begin_(std::min(pieces, size_ * ranks.rank())),
          numbers_(std::min(pieces, begin_ + size_) - begin_),
          of_ranks_(ranks.size()) {}

    /// Returns what processes tell of the pieces that they hold.
    std::vector<std::string> pack_sizes(const HeldPieces& held) const {
        std::vector<Packer> packers(of_ranks_.size());
        for (const HeldPiece& piece : held.pieces) {
            Packer& packer = packers[piece.piece / size_];
            packer.put_short(piece.piece % size_);
            packer.put_short(piece.facts.findings.inner_vertices);
            packer.put_short(piece.facts.findings.triangles);
        }
        return take_all(packers);
    }
    /// Takes what all have told. Returns the sum.
    PieceNumbers add_up(std::span<const std::string> told) {
        std::vector<std::uint32_t> times_made(numbers_.size(), 0);
        PieceNumbers sum;
        for (std::size_t rank = 0; rank < told.size(); ++rank)
            for (Unpacker unpacker(told[rank]); !unpacker.at_end();) {
                const std::size_t piece = of_ranks_[rank].emplace_back(unpacker.get_short());
                const std::uint64_t vertices = unpacker.get_short();
                numbers_[piece] = {vertices, unpacker.get_short()};  // its size at first
                sum.first_vertex += numbers_[piece].first_vertex;
                sum.first_triangle += numbers_[piece].first_triangle;
                ++times_made[piece];
            }
        for (std::size_t piece = 0; piece < times_made.size(); ++piece)
            if (times_made[piece] != 1)
                throw MeshError(fmt::format("piece {} was made {} times", begin_ + piece, times_made[piece]));
        return sum;
    }
    /// Numbers the pieces behind these vertices and triangles. Returns what those who hold them are told.
    std::vector<std::string> number(PieceNumbers next) {
        for (PieceNumbers& numbers : numbers_) {
            const PieceNumbers size = std::exchange(numbers, next);
            next.first_vertex += size.first_vertex;
            next.first_triangle += size.first_triangle;
        }
        std::vector<Packer> packers(of_ranks_.size());
        for (std::size_t rank = 0; rank < of_ranks_.size(); ++rank)
            for (const std::size_t piece : of_ranks_[rank]) {
                packers[rank].put_short(numbers_[piece].first_vertex);
                packers[rank].put_short(numbers_[piece].first_triangle);
            }
        return take_all(packers);
    }

private:
    std::size_t size_, begin_;
    std::vector<PieceNumbers> numbers_;
    std::vector<std::vector<std::size_t>> of_ranks_;  ///< for each rank those of its pieces that are in the block
};

/// Returns what each rank is told: where its block begins, and the counts of the mesh.
std::vector<std::string> begins_of_blocks(std::span<const std::string> sums, MeshCounts counts) {
    std::vector<Packer> packers(sums.size());
    for (std::size_t rank = 0; rank < sums.size(); ++rank) {
        packers[rank].put(PieceNumbers{counts.vertices, counts.triangles});
        const auto sum = Unpacker(sums[rank]).get<PieceNumbers>();
        counts.vertices += sum.first_vertex;
        counts.triangles += sum.first_triangle;
    }
    require_numbered(counts.vertices);
    for (Packer& packer : packers) packer.put(counts);
    return take_all(packers);
}

}  // namespace

NumberedPieces number_pieces(const HeldPieces& held, std::size_t pieces, const MeshCounts& before,
                             core::ConnectedRanks& ranks) {
    PieceBlock block(pieces, ranks);
    Packer sum;
    sum.put(block.add_up(ranks.exchange(block.pack_sizes(held))));
    const std::vector<std::string> sums = ranks.gather(sum.take());
    const std::string told = ranks.scatter(ranks.rank() == 0 ? begins_of_blocks(sums, before) : sums);
    Unpacker unpacker(told);
    const auto begin = unpacker.get<PieceNumbers>();
    NumberedPieces numbered{{}, unpacker.get<MeshCounts>()};
    // Pieces are held in ascending order, and so are blocks.
    for (const std::string& of_block : ranks.exchange(block.number(begin)))
        for (Unpacker numbers(of_block); !numbers.at_end();) {
            const std::uint64_t first_vertex = numbers.get_short();
            numbered.numbers.push_back({first_vertex, numbers.get_short()});
        }
    return numbered;
}

}  // namespace lamina::pipeline
