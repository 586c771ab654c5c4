// Meshes for tests of compressible flow: grids round sections, in the coordinates of confocal ellipses, cut into
// triangles.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "flow/euler/euler.hpp"
#include "support/shapes.hpp"

namespace lamina::test {

/// A mesh that owns its arrays.
struct SectionMesh {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    flow::euler::EulerWall wall;
    std::vector<Segment> far;

    flow::euler::EulerMesh view() const { return {points, triangles, {wall}, far}; }
};

/// The heights of the upper and of the lower side above the chord from 0 to 1.
struct Section {
    std::function<double(double)> upper, lower;
    bool blunt = false;  ///< whether the sides end at different points
};

inline double half_thickness_0012(double x) {
    return 0.6 * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))));
}

inline Section naca_0012() {
    return {half_thickness_0012, [](double x) { return -half_thickness_0012(x); }};
}

/// Returns the section with a base that is 1 % of the chord wide.
inline Section blunt_0012() {
    const auto half = [](double x) { return half_thickness_0012(x) + 0.005 * x; };
    return {half, [half](double x) { return -half(x); }, true};
}

/// Returns a section with a parabola of 2 % camber.
inline Section cambered() {
    const auto mean = [](double x) { return 0.08 * x * (1 - x); };
    return {[mean](double x) { return mean(x) + half_thickness_0012(x); },
            [mean](double x) { return mean(x) - half_thickness_0012(x); }};
}

/// Returns a symmetric diamond with this half angle at both ends.
inline Section diamond(double half_angle) {
    const double slope = std::tan(half_angle);
    const auto half = [slope](double x) { return slope * std::min(x, 1 - x); };
    return {half, [half](double x) { return -half(x); }};
}

/// Returns a mesh with `around` vertices on the wall, an even number, up to some `radius` chords. Cells are `aspect`
/// times as long as wide far away, and nearly square at the wall.
inline SectionMesh mesh_round(const Section& section, std::size_t around, double radius, double aspect = 1) {
    SectionMesh mesh;
    const double step = shapes::full_turn / static_cast<double>(around), last = std::log(4 * radius);
    std::size_t rows = 0;
    for (double eta = 0; eta < last; eta += step * (1 + (aspect - 1) * std::min(eta, 1.0)), ++rows)
        for (std::size_t k = 0; k < around; ++k) {
            const double shift = section.blunt ? 0.5 : 0;
            const double angle = step * (static_cast<double>(k) + shift), x = 0.5 + 0.5 * std::cos(angle);
            const double height = 2 * (static_cast<double>(k) + shift) <= static_cast<double>(around)
                                      ? section.upper(x)
                                      : section.lower(x);
            mesh.points.push_back({0.5 + 0.5 * std::cosh(eta) * std::cos(angle),
                                   0.5 * std::sinh(eta) * std::sin(angle) + height * std::exp(-eta)});
        }
    const auto vertex = [&](std::size_t row, std::size_t k) { return VertexId(row * around + k % around); };
    for (std::size_t row = 0; row + 1 < rows; ++row)
        for (std::size_t k = 0; k < around; ++k) {
            const VertexId a = vertex(row, k), b = vertex(row, k + 1), c = vertex(row + 1, k + 1),
                           d = vertex(row + 1, k);
            // Diagonals are mirror images of each other on both sides of the chord.
            if (2 * k < around) {
                mesh.triangles.push_back({{a, d, c}});
                mesh.triangles.push_back({{a, c, b}});
            } else {
                mesh.triangles.push_back({{a, d, b}});
                mesh.triangles.push_back({{d, c, b}});
            }
        }
    for (std::size_t k = 0; k < around; ++k) {
        mesh.wall.outline.push_back(vertex(0, k));
        mesh.far.push_back({vertex(rows - 1, k), vertex(rows - 1, k + 1)});
    }
    mesh.wall.sides_end = section.blunt ? around - 1 : around;
    return mesh;
}

}  // namespace lamina::test
