#include "pipeline/sharing/piece_store.hpp"

#include <string_view>
#include <utility>

namespace lamina::pipeline {

PieceStore::PieceStore(const std::optional<std::filesystem::path>& beside) {
    if (beside) file_ = std::make_unique<core::UnnamedFile>(*beside);
}

std::size_t PieceStore::put(decoupling::Subdomain subdomain, Refinement refinement) {
    Piece piece{std::move(subdomain),
                {.points = refinement.steiner_points.size(), .triangles = refinement.triangles.size()}};
    if (file_) {
        const auto bytes = [](const auto& values) {
            return std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
        };
        const std::string_view points = bytes(refinement.steiner_points), triangles = bytes(refinement.triangles);
        piece.offset = file_size_.fetch_add(points.size() + triangles.size());
        file_->write_at(piece.offset, points);
        file_->write_at(piece.offset + points.size(), triangles);
    } else {
        piece.refinement = std::move(refinement);
    }
    const std::lock_guard lock(mutex_);
    pieces_.push_back(std::move(piece));
    return pieces_.size() - 1;
}

Refinement PieceStore::read(std::size_t place) const {
    const Piece& piece = pieces_[place];
    Refinement refinement;
    refinement.steiner_points.resize(piece.counts.points);
    refinement.triangles.resize(piece.counts.triangles);
    const std::size_t point_bytes = piece.counts.points * sizeof(Point);
    file_->read_at(piece.offset, {reinterpret_cast<char*>(refinement.steiner_points.data()), point_bytes});
    file_->read_at(piece.offset + point_bytes,
                   {reinterpret_cast<char*>(refinement.triangles.data()), piece.counts.triangles * sizeof(Triangle)});
    return refinement;
}

}  // namespace lamina::pipeline
