#include "morphing/wall_edges.hpp"

#include <cstdint>

namespace lamina::morphing {

std::vector<Segment> edges_of_walls(const Mesh& mesh, const WallVertices& walls) {
    std::vector<VertexId> place(mesh.points.size());
    for (std::size_t i = 0; i < walls.vertex.size(); ++i) place[walls.vertex[i].index()] = VertexId(i);
    std::vector<Segment> edges;
    // Edges of markers have the mesh on their left, and the body on their right.
    for (const Marker& marker : mesh.markers)
        if (marker.kind == MarkerKind::wall)
            for (const Segment& edge : marker.edges) edges.push_back({place[edge.b.index()], place[edge.a.index()]});
    return edges;
}

}  // namespace lamina::morphing
