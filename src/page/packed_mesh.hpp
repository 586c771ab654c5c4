// A mesh as few bytes, for a page that holds it.
#pragma once

#include <string>

#include <lamina/mesh.hpp>

namespace lamina::page {

/// Returns the mesh as a zlib stream. share/page/decode.js reads it, and says what its bytes mean. Vertices and cells
/// keep their numbers, but cells may start at another corner, vertices of no cell are left out, and coordinates are
/// rounded as steps.hpp says. Precondition: all indices are in range, and coordinates are finite. Throws MeshError
/// where zlib lacks memory.
std::string pack_mesh(const Mesh& mesh);

}  // namespace lamina::page
