// The compiler turns the loops below into vector operations: they have no branches, and each array is contiguous. One
// more copy of them is made for processors with wider registers than all of their kind have. No operation is fused or
// reordered, so all copies return the same bits.
#include "mesh/triangle_shapes.hpp"

#include <cassert>
#include <cmath>
#include <limits>

#include "core/cell_shape.hpp"
#include "core/predicates.hpp"

namespace lamina::mesh {

namespace {

/// The coordinates of the corners of triangles.
struct Corners {
    double ax[TriangleShapes::capacity], ay[TriangleShapes::capacity], bx[TriangleShapes::capacity],
        by[TriangleShapes::capacity], cx[TriangleShapes::capacity], cy[TriangleShapes::capacity];
};

/// Returns the determinant of orient2d() where its filter is certain, and 0 elsewhere.
inline double certain_turn(Point a, Point b, Point c) {
    const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), det = left - right;
    const double bound = core::orient2d_bound * (std::abs(left) + std::abs(right));
    return std::abs(det) > bound ? det : 0.0;
}

// std::max and std::min return references, which the compiler makes branches of.
inline double larger(double a, double b) { return a < b ? b : a; }
inline double smaller(double a, double b) { return b < a ? b : a; }

/// As core::measure_triangle(), without its branch.
inline void measure(const Corners& corners, std::size_t i, TriangleShapes& shapes) {
    // The squared lengths have relative errors below 5 units in the last place, and so has none of their sums more than
    // 24 units of the largest.
    constexpr double acuteness_error = 1e-14;
    const Point a{corners.ax[i], corners.ay[i]}, b{corners.bx[i], corners.by[i]}, c{corners.cx[i], corners.cy[i]};
    const double twice_area = cross(b - a, c - a);
    const double bc = squared_length(c - b), ca = squared_length(a - c), ab = squared_length(b - a);
    const double longest = larger(larger(bc, ca), ab), shortest = smaller(smaller(bc, ca), ab);
    const double middle = larger(smaller(bc, ca), smaller(larger(bc, ca), ab));
    const double smallest = core::degrees(core::first_quadrant_angle(twice_area, 0.5 * (longest + middle - shortest)));
    const double medium =
        core::degrees(core::first_quadrant_angle(twice_area, larger(0.0, 0.5 * (longest + shortest - middle))));
    const double aspect_ratio = longest / twice_area, mean_ratio = core::mean_ratio(twice_area, bc + ca + ab);
    const bool flat = !(twice_area > 0);
    shapes.area[i] = flat ? core::flat_shape.area : 0.5 * twice_area;
    shapes.min_angle_deg[i] = flat ? core::flat_shape.min_angle_deg : larger(0.0, smallest);
    shapes.max_angle_deg[i] = flat ? core::flat_shape.max_angle_deg : 180 - smallest - medium;
    shapes.aspect_ratio[i] = flat ? core::flat_shape.aspect_ratio : aspect_ratio;
    shapes.mean_ratio[i] = flat ? core::flat_shape.mean_ratio : mean_ratio;
    shapes.turn[i] = certain_turn(a, b, c);
    shapes.acuteness[i] = (shortest + middle - longest) - acuteness_error * longest;
}

[[gnu::flatten]] void measure_all(const Corners& corners, std::size_t n, TriangleShapes& shapes) {
    for (std::size_t i = 0; i < n; ++i) measure(corners, i, shapes);
}

/// Each of four lanes adds up every fourth number, which takes one vector operation. The last few go to the first
/// lanes.
inline ShapeTotals add_up_lanes(const TriangleShapes& shapes) {
    constexpr std::size_t lanes = 4;
    ShapeTotals totals[lanes];
    const auto add = [&](std::size_t lane, std::size_t i) {
        totals[lane].area += shapes.area[i];
        totals[lane].min_angle_sum += shapes.min_angle_deg[i];
        totals[lane].max_angle_sum += shapes.max_angle_deg[i];
        totals[lane].mean_ratio_sum += shapes.mean_ratio[i];
        totals[lane].min_angle_deg = smaller(totals[lane].min_angle_deg, shapes.min_angle_deg[i]);
        totals[lane].max_angle_deg = larger(totals[lane].max_angle_deg, shapes.max_angle_deg[i]);
        totals[lane].max_aspect_ratio = larger(totals[lane].max_aspect_ratio, shapes.aspect_ratio[i]);
    };
    std::size_t i = 0;
    for (; i + lanes <= shapes.size; i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) add(lane, i + lane);
    for (std::size_t lane = 0; i < shapes.size; ++i, ++lane) add(lane, i);
    ShapeTotals all;
    for (const ShapeTotals& lane : totals) {
        all.area += lane.area;
        all.min_angle_sum += lane.min_angle_sum;
        all.max_angle_sum += lane.max_angle_sum;
        all.mean_ratio_sum += lane.mean_ratio_sum;
        all.min_angle_deg = smaller(all.min_angle_deg, lane.min_angle_deg);
        all.max_angle_deg = larger(all.max_angle_deg, lane.max_angle_deg);
        all.max_aspect_ratio = larger(all.max_aspect_ratio, lane.max_aspect_ratio);
    }
    return all;
}

#if defined(__x86_64__) && defined(__GNUC__)
[[gnu::target("avx2"), gnu::flatten]] void measure_all_avx2(const Corners& corners, std::size_t n,
                                                            TriangleShapes& shapes) {
    for (std::size_t i = 0; i < n; ++i) measure(corners, i, shapes);
}
bool has_avx2() { return __builtin_cpu_supports("avx2") != 0; }
#else
void measure_all_avx2(const Corners& corners, std::size_t n, TriangleShapes& shapes) {
    measure_all(corners, n, shapes);
}
constexpr bool has_avx2() { return false; }
#endif

}  // namespace

void measure_triangles(const Point* points, std::span<const Triangle> triangles, TriangleShapes& shapes) {
    assert(triangles.size() <= TriangleShapes::capacity);
    const std::size_t n = triangles.size();
    Corners corners;
    for (std::size_t i = 0; i < n; ++i) {
        const Point a = points[triangles[i].v[0].index()], b = points[triangles[i].v[1].index()],
                    c = points[triangles[i].v[2].index()];
        corners.ax[i] = a.x;
        corners.ay[i] = a.y;
        corners.bx[i] = b.x;
        corners.by[i] = b.y;
        corners.cx[i] = c.x;
        corners.cy[i] = c.y;
    }
    shapes.size = n;
    (has_avx2() ? measure_all_avx2 : measure_all)(corners, n, shapes);
}

ShapeTotals add_up(const TriangleShapes& shapes) { return add_up_lanes(shapes); }

}  // namespace lamina::mesh
