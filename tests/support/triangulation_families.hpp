// Families of inputs that triangulation and refinement are both measured and validated on.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/sizing.hpp>

#include "support/constrained_cases.hpp"
#include "support/point_sets.hpp"

namespace lamina::test {

/// Returns about n points of a layer round NACA 0012: 50 on each ray, the second 1e-5 above the wall.
std::vector<Point> naca_layer_points(std::size_t n);
/// Returns about n points of the grid over a flat plate, 100 in each column, turned by an angle that is given by its
/// cosine and sine. Cells are rectangles, so their four corners are cocircular (up to rounding where turned).
std::vector<Point> flat_plate_points(std::size_t n, double cosine, double sine);

/// Returns points on two parallel lines with this slope.
std::vector<Point> points_on_two_lines(std::size_t n, double slope);

/// Returns points on the two axes.
std::vector<Point> points_on_a_cross(std::size_t n);

/// The unit square, to be refined to h(x) = size + gradation x. Border edges are at most 0.8 h long.
struct RefinementCase {
    Border border;
    double size = 0, gradation = 0;
    SizeField field{1.0};
};
/// Returns the square whose refinement has about this number of triangles. `area_ratio` is that of the largest to the
/// smallest triangle; 1: uniform.
RefinementCase unit_square_case(double triangles, double area_ratio);

}  // namespace lamina::test
