// Files of triangles alone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include <lamina/ids.hpp>

namespace lamina::io {

/// Reads the triangles of a .ele file that refers to this many points. Throws IoError, InputError with file and line.
std::vector<Triangle> read_triangle_elements(const std::filesystem::path& file, std::size_t first_index,
                                             std::size_t points);

}  // namespace lamina::io
