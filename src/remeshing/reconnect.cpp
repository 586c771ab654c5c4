// The triangles of a mesh made better with the vertices that it has. Source: L. A. Freitag, C. Ollivier-Gooch,
// Tetrahedral mesh improvement using swapping and smoothing, Int. J. Numer. Methods Eng. 40 (1997), in two dimensions.
#include <lamina/remesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "remeshing/passes.hpp"
#include "remeshing/region.hpp"

namespace lamina::remeshing {

namespace {

/// Returns the metric whose unit of length, at each vertex, is the mean length of the edges of remeshed triangles
/// there: sizes stay as they are. Vertices without such triangles have the unit matrix, which nothing uses.
std::vector<MetricTensor> metric_of_edges(const MeshView& mesh) {
    std::vector<double> sum(mesh.points.size(), 0), edges(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!is_remeshed(mesh, t)) continue;
        const auto& v = mesh.triangles[t].v;
        for (unsigned i = 0; i < 3; ++i) {
            const std::size_t a = v[i].index(), b = v[after(i)].index();
            const double edge = distance(mesh.points[a], mesh.points[b]);
            for (const std::size_t end : {a, b}) {
                sum[end] += edge;
                ++edges[end];
            }
        }
    }
    std::vector<MetricTensor> metric;
    for (std::size_t v = 0; v < sum.size(); ++v) {
        const double size = edges[v] > 0 ? sum[v] / edges[v] : 1;
        metric.push_back({1 / (size * size), 0, 1 / (size * size)});
    }
    return metric;
}

}  // namespace

}  // namespace lamina::remeshing

namespace lamina {

using namespace remeshing;

Mesh reconnect(const MeshView& given) {
    const MeshWithRegions with_regions(given);
    const MeshView& mesh = with_regions.view();
    const std::vector<MetricTensor> metric = metric_of_edges(mesh);
    MetricMesh region = take_region(mesh, metric, false);
    if (!region.triangles.empty()) {
        for (std::uint32_t t = 0; t < region.triangles.size(); ++t) region.renew(t);
        const BackgroundMetric background(region);
        Passes passes(region, background);
        // With 0, 1, 2, 4 and 8 the mean smallest angle of all cells round a NACA 0012 turned by 60 degrees is 37.71,
        // 38.11, 38.19, 38.24 and 38.26 degrees.
        constexpr int rounds = 4;
        for (int round = 0; round < rounds; ++round) {
            passes.swap_diagonals();
            passes.move_vertices();
        }
        passes.swap_diagonals();
    }
    std::vector<MetricTensor> at_vertices;
    return put_back(mesh, region, metric, at_vertices);
}

}  // namespace lamina
