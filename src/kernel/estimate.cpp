#include "kernel/estimate.hpp"

#include <algorithm>

#include "core/equilateral.hpp"
#include "kernel/triangulator.hpp"

namespace lamina::kernel {

namespace {

/// Mean area of the triangles that refinement makes, as a share of the bound (measured: docs/decisions/0002).
constexpr double mean_area_share = 0.69;

/// Integral of 1 / h^2 over a triangle with h linear between its corners, by halving the edge between the finest and
/// the coarsest corner until the sizes differ little.
double inverse_square_integral(double area, double ha, double hb, double hc, int depth) {
    const double low = std::min({ha, hb, hc}), high = std::max({ha, hb, hc});
    if (depth == 0 || high < 1.5 * low) {
        const double h = (ha + hb + hc) / 3;
        return area / (h * h);
    }
    const double mid = 0.5 * (low + high);
    const double third = ha + hb + hc - low - high;
    return inverse_square_integral(0.5 * area, low, mid, third, depth - 1) +
           inverse_square_integral(0.5 * area, mid, high, third, depth - 1);
}

}  // namespace

double estimated_triangles(double area, double mean_inverse_square_size) {
    return area * mean_inverse_square_size / (equilateral_area * mean_area_share);
}

double estimate_triangles(std::span<const Point> points, std::span<const float> sizes, const Tris& tris) {
    double integral = 0;
    for (const Tri& t : tris) {
        const auto [a, b, c] = t.v;
        const double area = 0.5 * cross(points[b] - points[a], points[c] - points[a]);
        integral += inverse_square_integral(area, sizes[a], sizes[b], sizes[c], 12);
    }
    return estimated_triangles(1, integral);
}

double estimate_triangles(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size) {
    Tris tris = triangulate_points(points);
    insert_segments(points, segments, tris);
    tris = keep_left_of_segments(segments, tris, points.size());
    std::vector<float> sizes(points.size());
    std::transform(points.begin(), points.end(), sizes.begin(), [&](Point p) { return static_cast<float>(size(p)); });
    return estimate_triangles(points, sizes, tris);
}

}  // namespace lamina::kernel
