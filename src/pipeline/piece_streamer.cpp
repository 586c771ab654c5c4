#include "pipeline/piece_streamer.hpp"

#include <span>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "pipeline/parts.hpp"

namespace lamina::pipeline {

PieceStreamer::PieceStreamer(const Decoupling& decoupling, const LayerCells& cells, MeshSink& sink)
    : decoupling_(decoupling),
      cells_(cells),
      sink_(sink),
      window_(std::size_t{4} * thread_count()),
      counts_{decoupling.points.size(), cells.triangles.size(), cells.quads.size(), cells.triangles.size()},
      in_order_([this](const MeshSink::Bytes& bytes) { sink_.append(bytes); }) {
    for (const MeshPart& part : parts_of_points(decoupling.points)) sink_.append(sink_.format(part));
    for (const MeshPart& part : parts_of_layer(decoupling.points, cells)) sink_.append(sink_.format(part));
    hash_.add(decoupling.points, std::span<const Triangle>(cells.triangles));
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
    for (NumberedPiece& numbered : number(piece, std::move(refinement))) hand_on(std::move(numbered));
}

/// Returns the pieces whose numbers are known now.
std::vector<PieceStreamer::NumberedPiece> PieceStreamer::number(std::size_t piece, Refinement refinement) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(piece, std::move(refinement));
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
    const Subdomain& subdomain = decoupling_.subdomains[piece.number];
    const mesh::HashOfParts hash = hash_of_piece(subdomain, piece.refinement);
    number_in_mesh(subdomain, piece.first_vertex, piece.refinement);
    MeshSink::Bytes bytes = sink_.format(part_of_piece(decoupling_.points, cells_.pieces(), piece.number,
                                                       piece.first_vertex, piece.first_triangle, piece.refinement));
    piece.refinement = {};
    in_order_.put(piece.number, std::move(bytes));
    const std::lock_guard lock(mutex_);
    hash_.add(hash);
    ++written_;
    changed_.notify_all();
}

void PieceStreamer::finish(std::span<const Marker> markers, std::span<const Segment> constraints) {
    for (const MeshPart& part : parts_behind_pieces(decoupling_.points, cells_, counts_.triangles))
        sink_.append(sink_.format(part));
    hash_.add(decoupling_.points, std::span<const Quad>(cells_.quads));
    hash_.add(decoupling_.points, markers);
    sink_.finish(counts_, markers, constraints);
}

}  // namespace lamina::pipeline
