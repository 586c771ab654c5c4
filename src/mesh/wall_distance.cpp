// Distances to the walls.
#include <cmath>
#include <utility>
#include <vector>

#include <lamina/mesh.hpp>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/segments.hpp"

namespace lamina {

std::vector<double> wall_distances(const MeshView& mesh) {
    struct WallSegment {
        Point a, b;
    };
    std::vector<WallSegment> edges;
    std::vector<Box> boxes;
    for (const Marker& marker : mesh.markers) {
        if (marker.kind != MarkerKind::wall) continue;
        for (const Segment& edge : marker.edges) {
            edges.push_back({mesh.points[edge.a.index()], mesh.points[edge.b.index()]});
            boxes.emplace_back().include(edges.back().a);
            boxes.back().include(edges.back().b);
        }
    }
    std::vector<double> distances(mesh.points.size(), HUGE_VAL);
    if (edges.empty()) return distances;
    const core::BoxTree tree(std::move(boxes));
    core::parallel_for(distances.size(), std::size_t{1} << 10, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Point p = mesh.points[i];
            distances[i] = tree.min_distance(
                p, HUGE_VAL, [&](std::size_t e) { return core::distance_to_segment(p, edges[e].a, edges[e].b); });
        }
    });
    return distances;
}

}  // namespace lamina
