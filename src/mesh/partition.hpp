// Parts of a mesh for the processes of a solver.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

namespace lamina::mesh {

/// Divides the cells of a mesh into compact parts whose numbers of cells differ by one at most, and returns the part of
/// each cell, triangles first, from 0. A set of cells is halved across the longer side of the box round their middles,
/// and its halves again (recursive coordinate bisection). Throws OptionError for 0 parts. O(n log parts).
/// Source: M. J. Berger, S. H. Bokhari, A partitioning strategy for nonuniform problems on multiprocessors, IEEE Trans.
/// Comput. 36 (1987).
LAMINA_EXPORT std::vector<std::uint32_t> partition_cells(const MeshView& mesh, std::size_t parts);

}  // namespace lamina::mesh
