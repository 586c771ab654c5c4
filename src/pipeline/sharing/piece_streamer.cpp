#include "pipeline/sharing/piece_streamer.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "decoupling/refine_all.hpp"
#include "pipeline/sharing/parts.hpp"

namespace lamina::pipeline {

PieceStreamer::PieceStreamer(const decoupling::Decoupling& decoupling, PartTaker& taker, bool with_hash)
    : decoupling_(decoupling),
      taker_(taker),
      with_hash_(with_hash),
      window_(std::size_t{8} * thread_count()),
      in_order_([](const PartTaker::Append& append) { append(); }) {}

std::vector<std::size_t> PieceStreamer::order() const {
    const std::span<const decoupling::Subdomain> subdomains = decoupling_.subdomains;
    // begin() lets all of the last ones be made once those before them are.
    const std::size_t in_turn = subdomains.size() - std::min(subdomains.size(), window_);
    std::vector<std::size_t> order(in_turn);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (const std::size_t last : decoupling::largest_first(subdomains.subspan(in_turn)))
        order.push_back(in_turn + last);
    return order;
}

void PieceStreamer::start(const layers::LayerCells& cells) {
    for (const MeshPart& part : parts_of_points(decoupling_.points)) taker_.take(part);
    for (const MeshPart& part : parts_of_layer(decoupling_.points, cells)) taker_.take(part);
    if (with_hash_) hash_.add(decoupling_.points, std::span<const Triangle>(cells.triangles));
    std::vector<NumberedPiece> numbered;
    {
        const std::lock_guard lock(mutex_);
        cells_ = &cells;
        counts_ = {decoupling_.points.size(), cells.triangles.size(), cells.quads.size(), cells.triangles.size()};
        numbered = number_waiting();
    }
    for (NumberedPiece& piece : numbered) hand_on(std::move(piece));
}

void PieceStreamer::begin(std::size_t piece) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failed_ || piece < written_ + window_; });
    if (failed_) throw MeshError("another piece of the mesh has failed");
}

void PieceStreamer::fail() {
    const std::lock_guard lock(mutex_);
    failed_ = true;
    changed_.notify_all();
}

void PieceStreamer::take(std::size_t piece, Refinement refinement) {
    std::vector<NumberedPiece> numbered;
    {
        const std::lock_guard lock(mutex_);
        waiting_.emplace(piece, std::move(refinement));
        if (cells_ != nullptr) numbered = number_waiting();
    }
    for (NumberedPiece& next : numbered) hand_on(std::move(next));
}

/// Returns the pieces whose numbers are known now. The mutex must be held.
std::vector<PieceStreamer::NumberedPiece> PieceStreamer::number_waiting() {
    std::vector<NumberedPiece> numbered;
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == next_; ++next_) {
        numbered.push_back({next_, counts_.vertices, counts_.triangles, std::move(first->second)});
        first = waiting_.erase(first);
        first_triangle_.push_back(counts_.triangles);
        counts_.vertices += numbered.back().refinement.steiner_points.size();
        counts_.triangles += numbered.back().refinement.triangles.size();
        require_numbered(counts_.vertices);
    }
    return numbered;
}

void PieceStreamer::hand_on(NumberedPiece piece) {
    const decoupling::Subdomain& subdomain = decoupling_.subdomains[piece.number];
    mesh::HashOfParts hash;
    if (with_hash_) hash = hash_of_piece(subdomain, piece.refinement);
    number_in_mesh(subdomain, piece.first_vertex, piece.refinement);
    auto refinement = std::make_shared<const Refinement>(std::move(piece.refinement));
    const MeshPart part = part_of_piece(decoupling_.points, cells_->pieces(), piece.number, piece.first_vertex,
                                        piece.first_triangle, *refinement);
    in_order_.put(piece.number, taker_.prepare(part, std::move(refinement)));
    const std::lock_guard lock(mutex_);
    hash_.add(hash);
    ++written_;
    changed_.notify_all();
}

void PieceStreamer::finish(std::span<const Marker> markers) {
    for (const MeshPart& part : parts_behind_pieces(decoupling_.points, *cells_, counts_.triangles)) taker_.take(part);
    if (!with_hash_) return;
    hash_.add(decoupling_.points, std::span<const Quad>(cells_->quads));
    hash_.add(decoupling_.points, markers);
}

}  // namespace lamina::pipeline
