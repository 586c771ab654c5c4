// The metric between the vertices of the mesh that it was given on.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/remesh.hpp>

#include "remeshing/metric_mesh.hpp"

namespace lamina::remeshing {

/// A metric whose tensor of sizes, M^(-1/2), is linear in each triangle: an isotropic one has linear sizes, as size
/// fields with a gradation have. Source: Borouchaki et al. 1997, interpolation of metrics.
class BackgroundMetric {
public:
    /// Takes the triangles of a mesh, with its metrics, as they are now.
    explicit BackgroundMetric(const MetricMesh& mesh);

    /// A metric, and the triangle that holds its place.
    struct Sample {
        MetricTensor metric;
        std::uint32_t triangle;
    };
    /// Returns the metric at a point by a walk from a triangle near it. A point beyond the border, where rounding puts
    /// those of straight lines, has the metric of a place on the border.
    Sample at(Point p, std::uint32_t hint) const;

private:
    std::array<double, 3> weights(Point p, const MeshTriangle& triangle) const;

    std::vector<Point> points_;
    std::vector<MetricTensor> sizes_;  ///< per point
    std::vector<MeshTriangle> triangles_;
};

}  // namespace lamina::remeshing
