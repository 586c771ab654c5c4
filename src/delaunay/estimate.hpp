// How many triangles refinement will make, before it runs.
#pragma once

#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

/// Of a region far larger than its triangles, in which h grows by `gradient` per unit of distance.
LAMINA_EXPORT double estimated_triangles(double area, double mean_inverse_square_size, double gradient);

/// Where they will be: points in a triangle of a triangulation, each with a share of what the triangle will hold.
struct Load {
    Point at;
    double triangles;
};
/// Loads of all triangles one after the other: those of triangle t lie in [begin[t], begin[t + 1]).
struct Loads {
    std::vector<Load> loads;
    std::vector<std::size_t> begin{0};
    double total = 0;
    bool lattice = false;  ///< whether a lattice may pay (RefineOptions::lattice)
};

/// From a triangulation of a piece, all of whose fixed edges are frozen.
LAMINA_EXPORT Loads estimate_loads(std::span<const Point> points, const Tris& tris, const SizeField& size);

}  // namespace lamina::delaunay
