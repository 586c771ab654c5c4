#include "kernel/estimate.hpp"

#include <algorithm>

#include "core/equilateral.hpp"
#include "kernel/triangulator.hpp"

namespace lamina::kernel {

namespace {

/// Mean area of the triangles that refinement makes, as a share of the bound (measured: docs/decisions/0002).
constexpr double mean_area_share = 0.69;

/// Triangles with edges longer than this many times h are looked into.
constexpr double wide = 16;

struct Corner {
    Point at;
    double size;
};

double squared_edge(const Corner& a, const Corner& b) { return squared_length(b.at - a.at); }

/// Integral of 1 / h^2 over a triangle with h linear between its corners, by halving the edge between the finest and
/// the coarsest corner until the sizes differ little. A triangle so wide that h may be another one inside, as where it
/// spans the space between three fine borders, is halved at its longest edge, and h looked up, until it is not.
double inverse_square_integral(Corner a, Corner b, Corner c, const SizeField& size, int depth) {
    // a becomes the finest, c the coarsest.
    if (b.size < a.size) std::swap(a, b);
    if (c.size < b.size) std::swap(b, c);
    if (b.size < a.size) std::swap(a, b);
    const double ab = squared_edge(a, b), bc = squared_edge(b, c), ca = squared_edge(c, a);
    const double longest = std::max({ab, bc, ca});
    const bool is_wide = longest > wide * wide * a.size * a.size, alike = c.size < 1.5 * a.size;
    double inside = (a.size + b.size + c.size) / 3;
    if (is_wide && alike) inside = size((1.0 / 3) * (a.at + b.at + c.at));
    if (depth == 0 || (alike && inside < 1.5 * a.size))
        return 0.5 * std::abs(cross(b.at - a.at, c.at - a.at)) / (inside * inside);
    if (is_wide && ca < longest) (ab < longest) ? std::swap(a, b) : std::swap(b, c);
    const Point half = midpoint(a.at, c.at);
    const Corner between{half, is_wide ? size(half) : 0.5 * (a.size + c.size)};
    return inverse_square_integral(a, b, between, size, depth - 1) +
           inverse_square_integral(between, b, c, size, depth - 1);
}

}  // namespace

double estimated_triangles(double area, double mean_inverse_square_size) {
    return area * mean_inverse_square_size / (equilateral_area * mean_area_share);
}

double estimate_triangles(std::span<const Point> points, const Tris& tris, const SizeField& size) {
    constexpr int deepest = 40;  // halvings of one triangle: a guard only
    std::vector<double> sizes(points.size());
    std::transform(points.begin(), points.end(), sizes.begin(), [&](Point p) { return size(p); });
    double integral = 0;
    for (const Tri& t : tris) {
        const auto corner = [&](Index v) { return Corner{points[v], sizes[v]}; };
        integral += inverse_square_integral(corner(t.v[0]), corner(t.v[1]), corner(t.v[2]), size, deepest);
    }
    return estimated_triangles(1, integral);
}

double estimate_triangles(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size) {
    Tris tris = triangulate_points(points);
    insert_segments(points, segments, tris);
    tris = keep_left_of_segments(segments, tris, points.size());
    return estimate_triangles(points, tris, size);
}

}  // namespace lamina::kernel
