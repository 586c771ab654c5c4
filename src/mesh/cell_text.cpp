#include "mesh/cell_text.hpp"

#include <fmt/format.h>

namespace lamina::mesh {

std::string cell_text(const MeshView& mesh, std::size_t cell) {
    if (cell < mesh.triangles.size()) {
        const VertexId* v = mesh.triangles[cell].v;
        return fmt::format("triangle {} ({}, {}, {})", cell, v[0].value, v[1].value, v[2].value);
    }
    const VertexId* v = mesh.quads[cell - mesh.triangles.size()].v;
    return fmt::format("quad {} ({}, {}, {}, {})", cell - mesh.triangles.size(), v[0].value, v[1].value, v[2].value,
                       v[3].value);
}

std::string edge_text(const Segment& edge) { return fmt::format("{}-{}", edge.a.value, edge.b.value); }

}  // namespace lamina::mesh
