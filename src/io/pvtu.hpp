// Meshes in parts, each a VTU file, and the list of them. pvtu_write.cpp describes the files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::io {

/// A part of a mesh with its own numbers of vertices.
struct PartMesh {
    Mesh mesh;
    std::vector<VertexId> vertices;  ///< their numbers in the whole mesh, ascending
};

/// Returns the name of the file of a part.
std::filesystem::path part_file(const std::filesystem::path& file, std::size_t part);

/// Returns the list of the first so many parts. `arrays` has the arrays per cell that the parts have.
std::string list_of_parts(const MeshView& arrays, const std::filesystem::path& file, std::size_t parts);

}  // namespace lamina::io
