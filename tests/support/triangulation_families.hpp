// Families of inputs that the kernel is both measured and validated on.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/sizing.hpp>

#include "support/point_sets.hpp"

namespace lamina::test {

/// About n points of a layer round NACA 0012: 50 along each ray, the first 1e-5 off the wall.
std::vector<Point> naca_layer_points(std::size_t n);
/// About n points of the grid over a flat plate, 100 in each column, turned by an angle given by its cosine and sine:
/// cells are rectangles, every four points cocircular (up to rounding where turned).
std::vector<Point> flat_plate_points(std::size_t n, double cosine, double sine);

/// A unit square to be filled with about `triangles` triangles of h(x) = size + gradation x; its border, pre-cut to
/// 0.8 h.
struct RefinementCase {
    Border border;
    double size = 0, gradation = 0;
    SizeField field{1.0};
};
/// area_ratio: of the largest to the smallest triangle. 1 = uniform.
RefinementCase unit_square_case(double triangles, double area_ratio);

/// Points and segments between them that do not cross: edges of the Delaunay triangulation of the points stretched by
/// 16 in y (exactly), most of which are no Delaunay edges of the points as they are.
struct ConstrainedCase {
    std::vector<Point> points;
    std::vector<Segment> segments;
};
ConstrainedCase stretched_edges_case(std::size_t points, std::size_t one_edge_in);

}  // namespace lamina::test
