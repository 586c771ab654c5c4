// The quality of a mesh before and after it was morphed.
#include <lamina/morph.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"
#include "mesh/quality.hpp"

namespace lamina::morphing {

namespace {

/// Sums and extremes over cells.
struct QualityPart {
    double min_angle_deg = 180, angle_sum_deg = 0, min_sine = 1;
};

/// Returns the smallest sine of the angles of a polygon at its corners, which is negative where it turns back.
double smallest_sine(std::span<const Point> p) {
    double least = 1;
    for (std::size_t i = 0, n = p.size(); i < n; ++i) {
        const Point on = p[(i + 1) % n] - p[i], back = p[(i + n - 1) % n] - p[i];
        least = std::min(least, cross(on, back) / std::sqrt(squared_length(on) * squared_length(back)));
    }
    return least;
}

MorphQuality measure_quality(const Mesh& mesh, std::span<const Point> points) {
    const std::size_t triangles = mesh.triangles.size(), cells = triangles + mesh.quads.size();
    const auto at = [&](VertexId v) { return points[v.index()]; };
    const auto measure = [&](std::size_t begin, std::size_t end) {
        QualityPart part;
        for (std::size_t cell = begin; cell < end; ++cell) {
            double angle = 0;
            if (cell < triangles) {
                const auto& v = mesh.triangles[cell].v;
                const std::array p{at(v[0]), at(v[1]), at(v[2])};
                angle = core::measure_triangle(p[0], p[1], p[2]).min_angle_deg;
                part.min_sine = std::min(part.min_sine, smallest_sine(p) / (0.5 * std::numbers::sqrt3));
            } else {
                const auto& v = mesh.quads[cell - triangles].v;
                const std::array p{at(v[0]), at(v[1]), at(v[2]), at(v[3])};
                angle = mesh::measure_quad(p[0], p[1], p[2], p[3]).min_angle_deg;
                part.min_sine = std::min(part.min_sine, smallest_sine(p));
            }
            part.min_angle_deg = std::min(part.min_angle_deg, angle);
            part.angle_sum_deg += angle;
        }
        return part;
    };
    QualityPart sum;
    for (const QualityPart& part : core::parallel_blocks(cells, std::size_t{1} << 13, measure)) {
        sum.min_angle_deg = std::min(sum.min_angle_deg, part.min_angle_deg);
        sum.angle_sum_deg += part.angle_sum_deg;
        sum.min_sine = std::min(sum.min_sine, part.min_sine);
    }
    return {sum.min_angle_deg, sum.angle_sum_deg / static_cast<double>(std::max<std::size_t>(cells, 1)), sum.min_sine};
}

}  // namespace

}  // namespace lamina::morphing

namespace lamina {

MorphReport compare_morphed(const MorphMap& map, std::span<const Point> points) {
    const Mesh& reference = map.reference();
    MorphReport report{.before = morphing::measure_quality(reference, reference.points),
                       .after = morphing::measure_quality(reference, points)};
    Mesh morphed = reference;
    morphed.points.assign(points.begin(), points.end());
    const WallVertices& walls = map.walls();
    const WallVertices moved = wall_vertices(morphed);
    for (std::size_t i = 0; i < walls.vertex.size(); ++i) {
        const double before = walls.first_height[i], change = std::abs(moved.first_height[i] / before - 1);
        if (!(change > report.max_first_height_change)) continue;
        report.max_first_height_change = change;
        report.max_first_height_change_at = map.wall_points()[i];
    }
    return report;
}

}  // namespace lamina
