// Plain Delaunay triangulation on the linked triangles of triangles.hpp; triangulate() and refine() are built on it.
#pragma once

#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/triangulation.hpp>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Returns the Delaunay triangulation of distinct points, closed by ghost triangles; empty where all points lie on one
/// line. Throws InputError for duplicates, for coordinates outside the exact range and for more points than one
/// triangulation can number. With `stand_in` (merge_points()) points that others stand for are left out.
LAMINA_EXPORT Tris triangulate_points(std::span<const Point> points, std::span<const std::uint32_t> stand_in = {});

/// A triangulation whose vertices are numbered from 1 in the order of their insertion.
struct OrderedTriangulation {
    std::vector<Point> vertices;   ///< number 0 is not used
    Tris tris;                     ///< closed by ghosts; empty where all points lie on one line
    std::vector<Index> at_vertex;  ///< one triangle at each vertex
};

/// Returns the Delaunay triangulation of the points that `order` lists, inserted in this order, which should be a
/// biased randomised one (brio.hpp) for speed. Vertex i + 1 is points[order[i]]. If the first three points lie on one
/// line, the third one and a later one swap places in `order`. Throws InputError for duplicates.
/// Precondition: coordinates in the exact range, and no more points than one triangulation can number.
OrderedTriangulation triangulate_in_order(std::span<const Point> points, std::vector<Index>& order);

/// Returns all triangles but the ghosts.
Triangulation without_ghosts(const Tris& tris);

}  // namespace lamina::delaunay
