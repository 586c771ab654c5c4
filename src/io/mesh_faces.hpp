// The faces of a mesh for formats that describe cells by their faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"

namespace lamina::io {

/// The edges of a mesh, each once, as faces between two cells or between a cell and the outside. The arrays of the mesh
/// must outlive this object.
struct MeshFaces {
    mesh::CellEdges edges;
    mesh::Adjacency adjacency;
    /// Directed edges of `edges`: first each edge between two cells, as that of the lower cell, sorted by this cell,
    /// then by the other; then those of each marker, in the order of its edges.
    std::vector<std::uint32_t> faces{};
    std::size_t internal = 0;  ///< number of faces between two cells

    /// Returns the cell on the left of a face, which is the lower of two.
    std::size_t owner(std::size_t face) const { return edges.cell_of(faces[face]); }
    /// Returns the cell on the right. Precondition: face < internal.
    std::size_t neighbour(std::size_t face) const { return edges.cell_of(adjacency.twin[faces[face]]); }
    VertexId origin(std::size_t face) const { return edges.origin(faces[face]); }
    VertexId target(std::size_t face) const { return edges.target(faces[face]); }
};

/// Finds the faces. Throws MeshError, which names the file and the format, where the mesh is not conforming, or where
/// its boundary and its markers are not the same, with the cell on the left of each edge.
MeshFaces find_faces(const MeshView& mesh, const std::filesystem::path& file, const char* format);

}  // namespace lamina::io
