// The walk is a remembering stochastic walk, which ends in any triangulation. Source: O. Devillers, S. Pion, M.
// Teillaud, Walking in a triangulation, Int. J. Found. Comput. Sci. 13 (2002).
#include "remeshing/background.hpp"

#include <algorithm>

#include "core/random.hpp"
#include "remeshing/metric.hpp"

namespace lamina::remeshing {

BackgroundMetric::BackgroundMetric(const MetricMesh& mesh) : triangles_(mesh.triangles) {
    points_.reserve(mesh.vertices.size());
    sizes_.reserve(mesh.vertices.size());
    for (const MeshVertex& vertex : mesh.vertices) {
        points_.push_back(vertex.at);
        sizes_.push_back(vertex.is_used() ? sizes_of(vertex.metric) : MetricTensor{});
    }
}

std::array<double, 3> BackgroundMetric::weights(Point p, const MeshTriangle& triangle) const {
    const Point a = points_[triangle.v[0]] - p, b = points_[triangle.v[1]] - p, c = points_[triangle.v[2]] - p;
    return {cross(b, c), cross(c, a), cross(a, b)};
}

BackgroundMetric::Sample BackgroundMetric::at(Point p, std::uint32_t hint) const {
    std::uint32_t at = hint, from = hint;
    std::array<double, 3> w = weights(p, triangles_[at]);
    for (std::uint32_t step = 0; step < triangles_.size() && std::min({w[0], w[1], w[2]}) < 0; ++step) {
        const MeshTriangle& triangle = triangles_[at];
        std::uint32_t next = at;
        const unsigned first = static_cast<unsigned>(core::splitmix64(step) % 3);
        for (unsigned i = first; i < first + 3 && next == at; ++i) {
            const std::uint32_t beyond = triangle.n[i % 3];
            if (w[i % 3] < 0 && !is_border(beyond) && triangle_of(beyond) != from) next = triangle_of(beyond);
        }
        if (next == at) break;
        from = std::exchange(at, next);
        w = weights(p, triangles_[at]);
    }
    for (double& weight : w) weight = std::max(weight, 0.0);
    const double scale = 1 / (w[0] + w[1] + w[2]);
    const auto& v = triangles_[at].v;
    const MetricTensor sum = scale * (w[0] * sizes_[v[0]] + w[1] * sizes_[v[1]] + w[2] * sizes_[v[2]]);
    return {metric_of(sum), at};
}

}  // namespace lamina::remeshing
