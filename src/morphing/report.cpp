// The quality of a mesh before and after it was morphed.
#include <lamina/morph.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "mesh/adjacency.hpp"
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

MorphQuality measure_quality(const Mesh& mesh) {
    const mesh::CellEdges cells(mesh);
    const auto measure = [&](std::size_t begin, std::size_t end) {
        QualityPart part;
        for (std::size_t cell = begin; cell < end; ++cell) {
            std::array<Point, 4> corners;
            const std::size_t n = cells.corners(cell);
            for (std::size_t i = 0; i < n; ++i) corners[i] = mesh.points[cells.corner(cell, i).index()];
            const auto& [a, b, c, d] = corners;
            const double angle =
                n == 3 ? core::measure_triangle(a, b, c).min_angle_deg : mesh::measure_quad(a, b, c, d).min_angle_deg;
            const double sine_of_ideal = n == 3 ? 0.5 * std::numbers::sqrt3 : 1;
            part.min_sine = std::min(part.min_sine, smallest_sine(std::span(corners).first(n)) / sine_of_ideal);
            part.min_angle_deg = std::min(part.min_angle_deg, angle);
            part.angle_sum_deg += angle;
        }
        return part;
    };
    QualityPart sum;
    for (const QualityPart& part : core::parallel_blocks(cells.cells(), mesh::cells_per_block, measure)) {
        sum.min_angle_deg = std::min(sum.min_angle_deg, part.min_angle_deg);
        sum.angle_sum_deg += part.angle_sum_deg;
        sum.min_sine = std::min(sum.min_sine, part.min_sine);
    }
    return {sum.min_angle_deg, sum.angle_sum_deg / static_cast<double>(std::max<std::size_t>(cells.cells(), 1)),
            sum.min_sine};
}

}  // namespace

}  // namespace lamina::morphing

namespace lamina {

MorphReport compare_morphed(const MorphMap& map, std::span<const Point> points) {
    Mesh morphed = map.reference();
    morphed.points.assign(points.begin(), points.end());
    return compare_morphed(map, morphed);
}

MorphReport compare_morphed(const MorphMap& map, const Mesh& morphed) {
    const Mesh& reference = map.reference();
    if (morphed.points.size() != reference.points.size())
        throw InputError({}, core::concat(morphed.points.size(), " points for the ", reference.points.size(),
                                          " vertices of the mesh"));
    MorphReport report{.before = morphing::measure_quality(reference), .after = morphing::measure_quality(morphed)};
    const WallVertices& walls = map.walls();
    const WallVertices moved = wall_vertices(morphed);
    if (moved.vertex != walls.vertex) throw InputError({}, "the walls of the mesh have other vertices");
    for (std::size_t i = 0; i < walls.vertex.size(); ++i) {
        const double before = walls.first_height[i], change = std::abs(moved.first_height[i] / before - 1);
        if (!(change > report.max_first_height_change)) continue;
        report.max_first_height_change = change;
        report.max_first_height_change_at = map.wall_points()[i];
    }
    return report;
}

}  // namespace lamina
