#include "pipeline/piece_store.hpp"

#include <string_view>
#include <utility>

namespace lamina::pipeline {

PieceStore::PieceStore(std::size_t pieces, const std::optional<std::filesystem::path>& beside) {
    if (!beside) {
        in_memory_.resize(pieces);
        return;
    }
    file_ = std::make_unique<core::UnnamedFile>(*beside);
    stored_.resize(pieces);
}

void PieceStore::put(std::size_t piece, Refinement refinement) {
    if (!file_) {
        in_memory_[piece] = std::move(refinement);
        return;
    }
    const auto bytes = [](const auto& values) {
        return std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
    };
    const std::string_view points = bytes(refinement.steiner_points), triangles = bytes(refinement.triangles);
    const std::size_t offset = size_.fetch_add(points.size() + triangles.size());
    file_->write_at(offset, points);
    file_->write_at(offset + points.size(), triangles);
    stored_[piece] = {offset, refinement.steiner_points.size(), refinement.triangles.size()};
}

PartCounts PieceStore::counts(std::size_t piece) const {
    if (file_) return {.points = stored_[piece].points, .triangles = stored_[piece].triangles};
    return {.points = in_memory_[piece].steiner_points.size(), .triangles = in_memory_[piece].triangles.size()};
}

Refinement PieceStore::read(std::size_t piece) const {
    const Stored& stored = stored_[piece];
    Refinement refinement;
    refinement.steiner_points.resize(stored.points);
    refinement.triangles.resize(stored.triangles);
    const std::size_t point_bytes = stored.points * sizeof(Point);
    file_->read_at(stored.offset, {reinterpret_cast<char*>(refinement.steiner_points.data()), point_bytes});
    file_->read_at(stored.offset + point_bytes,
                   {reinterpret_cast<char*>(refinement.triangles.data()), stored.triangles * sizeof(Triangle)});
    return refinement;
}

}  // namespace lamina::pipeline
