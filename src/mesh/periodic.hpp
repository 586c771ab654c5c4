// The two borders of a mesh that is one part of an endless row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

namespace lamina::mesh {

/// Two markers of kind periodic that are copies of each other.
struct PeriodicPair {
    std::size_t first = 0, second = 0;  ///< their numbers; the copy of `first` moved by the translation is `second`
    Point translation{};                ///< added to a vertex of `first`, it gives that of `second` exactly
    std::vector<std::pair<VertexId, VertexId>> vertices{};         ///< twins, from the left to the right
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges{};  ///< twins among the edges of both, in that order
};

/// Why two borders do not fit together.
struct PeriodicMismatch {
    std::string reason;  ///< a sentence
    Point at{};          ///< a vertex without a twin
};

/// The result of find_periodic_pair(): a pair, or a mismatch, or neither where no marker is of kind periodic.
struct PeriodicSearch {
    std::optional<PeriodicPair> pair{};          ///< the borders, if they are exact copies of each other
    std::optional<PeriodicMismatch> mismatch{};  ///< why they are not
};

/// Finds the pair among the markers.
LAMINA_EXPORT PeriodicSearch find_periodic_pair(std::span<const Point> points, std::span<const Marker> markers);

/// Returns so many copies of a mesh with periodic borders, joined where a border of one is that of the next: the mesh
/// itself, copies above, and as many below or one less. Markers go on through all copies. Regions and layers are kept,
/// and constraints are left out. Throws UsageError where the mesh has no exact pair of such borders.
LAMINA_EXPORT Mesh joined_copies(const Mesh& mesh, std::size_t copies);

}  // namespace lamina::mesh
