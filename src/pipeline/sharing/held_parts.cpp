#include "pipeline/sharing/held_parts.hpp"

#include <utility>

#include "core/parallel.hpp"
#include "pipeline/sharing/parts.hpp"

namespace lamina::pipeline {

namespace {

/// Places begin with the kind of part: more than there can be parts of one kind.
constexpr std::uint64_t parts_of_kind = std::uint64_t{1} << 40;

}  // namespace

HeldParts::HeldParts(std::unique_ptr<SharedDecoupling> shared, layers::LayerCells cells, HeldNumbers held,
                     const MeshCounts& counts, const core::ConnectedRanks& ranks)
    : shared_(std::move(shared)), cells_(std::move(cells)), held_(std::move(held)) {
    core::parallel_for(held_.pieces.size(), 1, [&](std::size_t i, std::size_t) {
        PieceStore& store = *held_.store;
        if (Refinement* refinement = store.in_memory(held_.places[i]))
            number_in_mesh(store.subdomain(held_.places[i]), held_.numbers[i].first_vertex, *refinement);
    });
    points_ = parts_of_points(shared_->points());
    for (std::size_t i = ranks.rank(); i < points_.size(); i += ranks.size()) own_points_.push_back(i);
    if (ranks.rank() != 0) return;
    layer_ = parts_of_layer(shared_->points(), cells_);
    behind_ = parts_behind_pieces(shared_->points(), cells_, counts.triangles);
}

std::vector<std::uint64_t> HeldParts::places() const {
    std::vector<std::uint64_t> places(own_points_.begin(), own_points_.end());
    for (std::size_t i = 0; i < layer_.size(); ++i) places.push_back(points_.size() + i);
    for (const std::size_t piece : held_.pieces) places.push_back(parts_of_kind + piece);
    for (std::size_t i = 0; i < behind_.size(); ++i) places.push_back(2 * parts_of_kind + i);
    return places;
}

void HeldParts::visit(std::size_t i, const std::function<void(const MeshPart&)>& take) const {
    if (i < own_points_.size()) {
        const MeshPart& part = points_[own_points_[i]];
        shared_->place(part.first_vertex, part.first_vertex + part.points.size());
        return take(part);
    }
    i -= own_points_.size();
    if (i < layer_.size()) return take(layer_[i]);
    i -= layer_.size();
    if (i >= held_.pieces.size()) return take(behind_[i - held_.pieces.size()]);
    const auto take_piece = [&](const Refinement& refinement) {
        take(part_of_piece(shared_->points(), held_.layer_pieces, held_.pieces[i], held_.numbers[i].first_vertex,
                           held_.numbers[i].first_triangle, refinement));
    };
    const PieceStore& store = *held_.store;
    const std::size_t place = held_.places[i];
    if (const Refinement* refinement = store.in_memory(place)) return take_piece(*refinement);
    Refinement refinement = store.read(place);
    number_in_mesh(store.subdomain(place), held_.numbers[i].first_vertex, refinement);
    take_piece(refinement);
}

mesh::PartCounts HeldParts::counts(std::size_t i) const {
    const auto of = [](const MeshPart& part) {
        return mesh::PartCounts{part.points.size(), part.triangles.size(), part.quads.size()};
    };
    if (i < own_points_.size()) return of(points_[own_points_[i]]);
    i -= own_points_.size();
    if (i < layer_.size()) return of(layer_[i]);
    i -= layer_.size();
    if (i >= held_.pieces.size()) return of(behind_[i - held_.pieces.size()]);
    return held_.store->counts(held_.places[i]);
}

}  // namespace lamina::pipeline
