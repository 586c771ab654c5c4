// One function to read and one to write a mesh for each format; io.cpp holds the table of them.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include <lamina/mesh.hpp>

namespace lamina::detail {

// Writers send the whole file to `out`; readers get the whole file as bytes, and its name for messages. Meshes come out
// with all indices in range and finite points; more is for check_mesh to say. Readers throw InputError.

void write_su2(const Mesh& mesh, const std::filesystem::path& file, std::ostream& out);
Mesh read_su2(const std::string& bytes, const std::filesystem::path& file);

void write_vtu(const Mesh& mesh, const std::filesystem::path& file, std::ostream& out);
Mesh read_vtu(const std::string& bytes, const std::filesystem::path& file);

/// Lower case, with the dot.
std::string extension_of(const std::filesystem::path& file);

/// Some programs write boundary edges either way round: turns those that no cell has in this direction, but one has
/// in the other. Precondition: indices in range.
void orient_markers(Mesh& mesh);

}  // namespace lamina::detail
