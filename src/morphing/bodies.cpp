#include "morphing/bodies.hpp"

#include <algorithm>

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

std::vector<Body> closed_bodies(const MorphMap& map) {
    const WallVertices& walls = map.walls();
    const std::size_t bodies = walls.body_first.size() - 1;
    std::vector<std::size_t> edges(bodies, 0);
    for (const Segment& edge : edges_of_walls(map.reference(), walls)) {
        const auto next = std::upper_bound(walls.body_first.begin(), walls.body_first.end(), edge.a.index());
        ++edges[static_cast<std::size_t>(next - walls.body_first.begin() - 1)];
    }
    std::vector<Body> closed;
    for (std::size_t b = 0; b < bodies; ++b) {
        const std::size_t first = walls.body_first[b], count = walls.body_first[b + 1] - first;
        if (edges[b] == count) closed.push_back({first, count, map.reference().markers[walls.marker[first]].name});
    }
    return closed;
}

Geometry as_geometry(std::span<const Body> bodies, std::span<const Point> wall) {
    Geometry geometry;
    for (const Body& body : bodies) {
        Element& element = geometry.elements.emplace_back();
        element.name = element.given_name = body.name;
        const auto first = wall.begin() + static_cast<std::ptrdiff_t>(body.first);
        element.points.assign(first, first + static_cast<std::ptrdiff_t>(body.count));
    }
    return geometry;
}

}  // namespace lamina::morphing
