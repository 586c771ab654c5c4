// Where a process keeps the pieces that it has made until it can number them.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/mesh_sink.hpp>

#include "core/unnamed_file.hpp"

namespace lamina::pipeline {

/// Keeps refinements in memory, or on the disk.
class PieceStore {
public:
    /// For this many pieces; on the disk of the file `beside`, if that is given. Throws IoError about it.
    PieceStore(std::size_t pieces, const std::optional<std::filesystem::path>& beside);

    /// Stores points and triangles of a piece, once for each. Any thread may call it. Throws IoError.
    void put(std::size_t piece, Refinement refinement);
    /// Returns the piece where it lies in memory; null: it is on the disk.
    Refinement* in_memory(std::size_t piece) { return file_ ? nullptr : &in_memory_[piece]; }
    const Refinement* in_memory(std::size_t piece) const { return file_ ? nullptr : &in_memory_[piece]; }
    /// Returns how many vertices and triangles a piece has.
    PartCounts counts(std::size_t piece) const;
    /// Returns a piece from the disk, without statistics. Any thread may call it. Throws IoError.
    Refinement read(std::size_t piece) const;

private:
    struct Stored {
        std::size_t offset = 0, points = 0, triangles = 0;
    };
    std::vector<Refinement> in_memory_;
    std::unique_ptr<core::UnnamedFile> file_;
    std::vector<Stored> stored_;  ///< in the file
    std::atomic<std::size_t> size_ = 0;
};

}  // namespace lamina::pipeline
