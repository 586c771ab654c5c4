#include "kernel/estimate.hpp"

#include <algorithm>
#include <iterator>

#include "core/equilateral.hpp"
#include "kernel/triangulator.hpp"

namespace lamina::kernel {

namespace {

/// Mean area of the triangles that refinement makes, as a share of the bound: the lattice of a level fits the better
/// the less h varies (measured: docs/decisions/0015).
double mean_area_share(double gradation) {
    struct Measured {
        double gradation, share;
    };
    constexpr Measured table[] = {{0.007, 0.79}, {0.01, 0.763}, {0.015, 0.683}, {0.05, 0.664},
                                  {0.1, 0.636},  {0.2, 0.592},  {0.3, 0.585}};
    if (gradation <= table[0].gradation) return table[0].share;
    for (std::size_t i = 1; i < std::size(table); ++i) {
        if (gradation > table[i].gradation) continue;
        const double t = (gradation - table[i - 1].gradation) / (table[i].gradation - table[i - 1].gradation);
        return table[i - 1].share + t * (table[i].share - table[i - 1].share);
    }
    return std::end(table)[-1].share;
}

/// Triangles with edges longer than this many times h are looked into. A source inside lowers h up to a distance of h /
/// gradation; and parts of a triangle are kept small enough to tell which side of a line they lie on.
double wide_triangle(const SizeField& size) { return std::clamp(1.6 / size.gradation(), 16.0, 40.0); }

struct Corner {
    Point at;
    double size;
};

double squared_edge(const Corner& a, const Corner& b) { return squared_length(b.at - a.at); }

/// Triangles of fewer h^2 than this are not looked into.
constexpr double small_triangle = 4;

/// Integral of 1 / h^2 over a triangle; add(point, part of the integral) is called for each part. The triangle is
/// halved at its longest edge until h differs little between the corners and the middle, and the triangle is not so
/// wide that a source inside could be overlooked.
template <class Add>
void inverse_square_integral(Corner a, Corner b, Corner c, const SizeField& size, double wide, int depth,
                             const Add& add) {
    const double area = 0.5 * std::abs(cross(b.at - a.at, c.at - a.at));
    const double low = std::min({a.size, b.size, c.size}), high = std::max({a.size, b.size, c.size});
    const double mean = (a.size + b.size + c.size) / 3;
    const Point center = (1.0 / 3) * (a.at + b.at + c.at);
    const bool small = area < small_triangle * low * low;
    if (small && high < 2 * low) {
        add(center, area / (mean * mean));
        return;
    }
    const double inside = small ? mean : size(center);
    // c-a becomes the longest edge.
    const double ab = squared_edge(a, b), bc = squared_edge(b, c), ca = squared_edge(c, a);
    if (ab >= bc && ab >= ca)
        std::swap(b, c);
    else if (bc >= ca)
        std::swap(a, b);
    const bool is_wide = std::max({ab, bc, ca}) > wide * wide * low * low;
    const bool alike = high < 1.5 * low && inside < 1.2 * mean && mean < 1.2 * inside;
    if (depth == 0 || (alike && !is_wide)) {
        const double h = 0.75 * inside + 0.25 * mean;
        add(center, area / (h * h));
        return;
    }
    const Point half = midpoint(a.at, c.at);
    const Corner between{half, size(half)};
    inverse_square_integral(a, b, between, size, wide, depth - 1, add);
    inverse_square_integral(between, b, c, size, wide, depth - 1, add);
}

/// The integral over each triangle, given to `add`; `done` is called after each.
template <class Add, class Done>
void integrate(std::span<const Point> points, const Tris& tris, const SizeField& size, const Add& add,
               const Done& done) {
    constexpr int deepest = 40;  // halvings of one triangle: a guard only
    const double wide = wide_triangle(size);
    std::vector<double> sizes(points.size());
    std::transform(points.begin(), points.end(), sizes.begin(), [&](Point p) { return size(p); });
    for (const Tri& t : tris) {
        const auto corner = [&](Index v) { return Corner{points[v], sizes[v]}; };
        inverse_square_integral(corner(t.v[0]), corner(t.v[1]), corner(t.v[2]), size, wide, deepest, add);
        done();
    }
}

}  // namespace

double estimated_triangles(double area, double mean_inverse_square_size, double gradation) {
    return area * mean_inverse_square_size / (equilateral_area * mean_area_share(gradation));
}

double estimate_triangles(std::span<const Point> points, const Tris& tris, const SizeField& size) {
    double integral = 0;
    integrate(
        points, tris, size, [&](Point, double part) { integral += part; }, [] {});
    return estimated_triangles(1, integral, size.gradation());
}

Loads estimate_loads(std::span<const Point> points, const Tris& tris, const SizeField& size) {
    Loads result;
    integrate(
        points, tris, size,
        [&](Point p, double part) {
            result.loads.push_back({p, estimated_triangles(1, part, size.gradation())});
        },
        [&] { result.begin.push_back(result.loads.size()); });
    return result;
}

}  // namespace lamina::kernel
