// The middles of cells.
#pragma once

#include <span>

#include <lamina/mesh.hpp>

namespace lamina::mesh {

/// Returns the mean of the corners of a cell.
inline Point middle_of_cell(const Mesh& mesh, std::span<const VertexId> corners) {
    Point sum{0, 0};
    for (const VertexId v : corners) sum = sum + mesh.points[v.index()];
    return (1.0 / static_cast<double>(corners.size())) * sum;
}

}  // namespace lamina::mesh
