// Where a process keeps the pieces that it has made until it can number them.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include <lamina/delaunay.hpp>
#include <lamina/mesh_sink.hpp>

#include "core/unnamed_file.hpp"
#include "decoupling/subdomain.hpp"
#include "mesh/shared_parts.hpp"

namespace lamina::pipeline {

/// Keeps subdomains, and their refinements in memory or on the disk. How many there will be need not be known.
class PieceStore {
public:
    /// On the disk of the file `beside`, if that is given. Throws IoError about it.
    explicit PieceStore(const std::optional<std::filesystem::path>& beside);

    /// Stores a piece, of whose refinement only points and triangles. Returns its place here. Any thread may call it.
    /// Throws IoError.
    std::size_t put(decoupling::Subdomain subdomain, Refinement refinement);
    const decoupling::Subdomain& subdomain(std::size_t place) const { return pieces_[place].subdomain; }
    /// Returns the refinement where it lies in memory; null: it is on the disk.
    Refinement* in_memory(std::size_t place) { return file_ ? nullptr : &pieces_[place].refinement; }
    const Refinement* in_memory(std::size_t place) const { return file_ ? nullptr : &pieces_[place].refinement; }
    /// Returns how many vertices and triangles a piece has.
    mesh::PartCounts counts(std::size_t place) const { return pieces_[place].counts; }
    /// Returns a refinement from the disk, without statistics. Any thread may call it. Throws IoError.
    Refinement read(std::size_t place) const;

private:
    struct Piece {
        decoupling::Subdomain subdomain;
        mesh::PartCounts counts;
        std::size_t offset = 0;   ///< in the file
        Refinement refinement{};  ///< in memory
    };
    std::unique_ptr<core::UnnamedFile> file_;
    std::atomic<std::size_t> file_size_ = 0;
    std::deque<Piece> pieces_;
    std::mutex mutex_;
};

}  // namespace lamina::pipeline
