// How many triangles refinement will make, before it runs.
#pragma once

#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "kernel/triangles.hpp"

namespace lamina::kernel {

/// From an area, the mean of 1 / h^2 over it, and the growth of h per unit of distance.
double estimated_triangles(double area, double mean_inverse_square_size, double gradation);

/// From a triangulation of the region.
double estimate_triangles(std::span<const Point> points, const Tris& tris, const SizeField& size);

/// Where they will be: points in a triangle of a triangulation, each with a share of what the triangle will hold.
struct Load {
    Point at;
    double triangles;
};
/// Loads of all triangles one after the other: those of triangle t lie in [begin[t], begin[t + 1]).
struct Loads {
    std::vector<Load> loads;
    std::vector<std::size_t> begin{0};
};
Loads estimate_loads(std::span<const Point> points, const Tris& tris, const SizeField& size);

}  // namespace lamina::kernel
