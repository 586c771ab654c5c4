#include "page/steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lamina::page {

namespace {

/// Returns the smallest height of a triangle; 0 for one without area.
double smallest_height(Point a, Point b, Point c) {
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    return longest > 0 ? std::abs(cross(b - a, c - a)) / longest : 0;
}

}  // namespace

std::vector<std::int16_t> step_exponents(const Mesh& mesh) {
    std::vector<double> height(mesh.points.size(), HUGE_VAL);
    const auto lower = [&](VertexId v, double to) { height[v.index()] = std::min(height[v.index()], to); };
    const auto add_corner = [&](VertexId a, VertexId b, VertexId c) {
        const double found = smallest_height(mesh.points[a.index()], mesh.points[b.index()], mesh.points[c.index()]);
        for (const VertexId v : {a, b, c}) lower(v, found);
    };
    for (const Triangle& t : mesh.triangles) add_corner(t.v[0], t.v[1], t.v[2]);
    for (const Quad& q : mesh.quads)
        for (std::size_t i = 0; i < 4; ++i) add_corner(q.v[i], q.v[(i + 1) % 4], q.v[(i + 2) % 4]);

    double largest = 0;
    for (const Point p : mesh.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    const int finest = largest > 0 ? std::ilogb(largest) + 1 - coordinate_bits : 0;
    std::vector<std::int16_t> exponents(height.size());
    for (std::size_t v = 0; v < height.size(); ++v) {
        const bool finite = height[v] > 0 && std::isfinite(height[v]);
        exponents[v] = static_cast<std::int16_t>(finite ? std::max(finest, std::ilogb(height[v]) - step_bits) : finest);
    }
    return exponents;
}

double steps_in(double x, int exponent) { return std::floor(std::ldexp(x, -exponent) + 0.5); }

}  // namespace lamina::page
