// Which cells belong to the isotropic region.
#pragma once

#include <lamina/mesh.hpp>

namespace lamina::mesh {

/// Returns whether a cell is isotropic. In a mesh without regions all cells are.
inline bool is_isotropic(const MeshView& mesh, std::size_t cell) {
    return mesh.region.empty() || mesh.region[cell] == Region::isotropic;
}

inline bool is_isotropic_triangle(const MeshView& mesh, std::size_t cell) {
    return cell < mesh.triangles.size() && is_isotropic(mesh, cell);
}

}  // namespace lamina::mesh
