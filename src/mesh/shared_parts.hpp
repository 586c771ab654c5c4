// The parts of a mesh that several processes hold together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <lamina/mesh_sink.hpp>

namespace lamina::mesh {

/// How much is in a part: points that it shares with other parts count.
struct PartCounts {
    std::size_t points = 0, triangles = 0, quads = 0;  ///< numbers of them
};

/// The parts of a mesh that one process holds, where several processes hold it together.
class MeshParts {
public:
    MeshParts() = default;
    MeshParts(const MeshParts&) = delete;
    MeshParts& operator=(const MeshParts&) = delete;
    virtual ~MeshParts() = default;

    /// Returns the places of these parts in the order of all parts of the mesh, ascending. Those of others lie between.
    virtual std::vector<std::uint64_t> places() const = 0;
    /// Calls take() with part i of these. May be called on several threads at once. Throws IoError.
    virtual void visit(std::size_t i, const std::function<void(const MeshPart&)>& take) const = 0;
    virtual PartCounts counts(std::size_t i) const = 0;  ///< how much is in part i, without reading it
};

}  // namespace lamina::mesh
