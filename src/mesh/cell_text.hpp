// Names of cells and edges in messages.
#pragma once

#include <string>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

namespace lamina::mesh {

/// Returns the number of a cell and its vertices: "triangle 7 (3, 5, 9)". Cells are the triangles, then the quads.
LAMINA_EXPORT std::string cell_text(const MeshView& mesh, std::size_t cell);

/// Returns the ends of an edge: "3-5".
LAMINA_EXPORT std::string edge_text(const Segment& edge);

}  // namespace lamina::mesh
