#include "pipeline/piece_streamer.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

namespace lamina::pipeline {

namespace {

/// Formatting on several threads at once pays for parts of this size.
constexpr std::size_t part_cells = 1 << 16;

/// Calls f(begin, end) for successive parts of [first, last).
template <class F>
void for_parts(std::size_t first, std::size_t last, F&& f) {
    for (std::size_t begin = first; begin < last; begin += part_cells) f(begin, std::min(last, begin + part_cells));
}

}  // namespace

PieceStreamer::PieceStreamer(const Decoupling& decoupling, const LayerCells& cells, MeshSink& sink)
    : decoupling_(decoupling),
      cells_(cells),
      sink_(sink),
      window_(std::size_t{4} * thread_count()),
      counts_{decoupling.points.size(), cells.triangles.size(), cells.quads.size(), cells.triangles.size()},
      in_order_([this](const MeshSink::Bytes& bytes) { sink_.append(bytes); }) {
    const std::span<const Point> points(decoupling.points);
    for_parts(0, points.size(), [&](std::size_t begin, std::size_t end) {
        sink_.append(sink_.format({.first_vertex = begin, .points = points.subspan(begin, end - begin)}));
    });
    const std::span<const Triangle> triangles(cells.triangles);
    for (std::size_t piece = 0; piece < cells.pieces(); ++piece)
        for_parts(
            cells.first_triangle[piece], cells.first_triangle[piece + 1], [&](std::size_t begin, std::size_t end) {
                sink_.append(sink_.format({.first_cell = begin,
                                           .triangles = triangles.subspan(begin, end - begin),
                                           .shared = points,
                                           .region = Region::layer,
                                           .piece = static_cast<std::uint32_t>(piece),
                                           .layers = std::span(cells.triangle_layer).subspan(begin, end - begin)}));
            });
    hash_.add(points, triangles);
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
        if (counts_.vertices >= VertexId{}.value)
            throw MeshError(fmt::format("the mesh has more vertices than 32-bit numbers can tell apart: {} so far",
                                        counts_.vertices));
    }
    return numbered;
}

void PieceStreamer::hand_on(NumberedPiece piece) {
    const Subdomain& subdomain = decoupling_.subdomains[piece.number];
    mesh::HashOfParts hash;
    {
        std::vector<Point> points = subdomain.points;
        points.insert(points.end(), piece.refinement.steiner_points.begin(), piece.refinement.steiner_points.end());
        hash.add(points, piece.refinement.triangles);
    }
    const std::size_t shift = piece.first_vertex - subdomain.global.size();
    for (Triangle& t : piece.refinement.triangles)
        for (VertexId& v : t.v)
            v = v.index() < subdomain.global.size() ? subdomain.global[v.index()] : VertexId{v.index() + shift};
    MeshSink::Bytes bytes = sink_.format({.first_vertex = piece.first_vertex,
                                          .points = piece.refinement.steiner_points,
                                          .first_cell = piece.first_triangle,
                                          .triangles = piece.refinement.triangles,
                                          .shared = decoupling_.points,
                                          .piece = static_cast<std::uint32_t>(cells_.pieces() + piece.number)});
    piece.refinement = {};
    in_order_.put(piece.number, std::move(bytes));
    const std::lock_guard lock(mutex_);
    hash_.add(hash);
    ++written_;
    changed_.notify_all();
}

void PieceStreamer::finish(std::span<const Marker> markers, std::span<const Segment> constraints) {
    const std::span<const Quad> quads(cells_.quads);
    for_parts(0, quads.size(), [&](std::size_t begin, std::size_t end) {
        sink_.append(sink_.format({.first_cell = counts_.triangles + begin,
                                   .shared = decoupling_.points,
                                   .region = Region::layer,
                                   .layers = std::span(cells_.quad_layer).subspan(begin, end - begin),
                                   .quads = quads.subspan(begin, end - begin)}));
    });
    hash_.add(decoupling_.points, quads);
    hash_.add(decoupling_.points, markers);
    sink_.finish(counts_, markers, constraints);
}

}  // namespace lamina::pipeline
