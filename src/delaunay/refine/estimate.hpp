// Estimates of the number of triangles that refinement will make, before it runs (docs/decisions/0013).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Number of triangles that refinement makes for each frozen edge, besides those that fill the region.
inline constexpr double refined_along_border = 0.15;

/// Returns the estimated number of triangles in a region of this area and this mean of 1 / h^2. The region is far
/// larger than its triangles, and h grows in it by `gradient` per unit of distance.
LAMINA_EXPORT double estimated_triangles(double area, double mean_inverse_square_size, double gradient);

/// A point that stands for some of the estimated triangles.
struct Load {
    Point at;
    double triangles;
};

/// The estimated number of triangles, and where they will be.
struct LoadEstimate {
    std::vector<Load> loads;            ///< triangle by triangle of the triangulation that the estimate is made from
    std::vector<std::size_t> begin{0};  ///< the loads in triangle t are those from begin[t] to begin[t + 1]
    double total = 0;
    bool lattice = false;  ///< whether a lattice may pay (RefineOptions::lattice)
};

/// Estimates the triangles in a region from a triangulation of its border. All constrained edges are frozen.
LAMINA_EXPORT LoadEstimate estimate_loads(std::span<const Point> points, const Tris& tris, const SizeField& size);

/// Returns true only where estimate_loads() finds more than so many triangles, and does not look at all of the
/// region then. Where it returns false there may be more as well.
LAMINA_EXPORT bool has_clearly_more_than(std::span<const Point> points, const Tris& tris, const SizeField& size,
                                         double triangles);

/// Estimates the triangles in a region that will be cut into subdomains. They are judged place by place: what is even
/// round a place decides whether a lattice is made there.
LAMINA_EXPORT double estimate_undivided(std::span<const Point> points, const Tris& tris, const SizeField& size);

}  // namespace lamina::delaunay
