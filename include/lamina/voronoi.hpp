// Voronoi diagrams: for each point the part of the plane that is nearer to it than to any other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/delaunay_connectivity.hpp>
#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// An edge of a Voronoi diagram that runs to infinity, between the cells of two neighbours on the hull.
struct VoronoiRay {
    VertexId a;           ///< the hull edge that it crosses at right angles, or would, begins here
    VertexId b;           ///< ... and ends here; the hull is on its left
    TriangleId triangle;  ///< the triangle at that edge, whose centre the ray starts from
    Point direction;      ///< away from the hull, as long as the edge
};

/// A Voronoi diagram. Its graph is exact: which centre is a corner of which cell follows from the triangles.
struct VoronoiDiagram {
    /// The centre of the circle through the corners of each triangle, rounded. Those of cocircular triangles agree up
    /// to rounding.
    std::vector<Point> corners;
    /// For each point the corners of its cell, counter-clockwise, by the indices of the triangles. Cells of points on
    /// the hull are open: they lie between a ray to their first corner and one from their last. Points in no triangle
    /// have none.
    IndexLists cells;
    std::vector<VoronoiRay> rays;  ///< one for each edge of the hull, in the order of boundary_loops()
};

/// Returns the Voronoi diagram of points, on all threads, in O(n). Precondition: the triangles are the Delaunay
/// triangulation of the points, as triangulate(points) returns it. Throws InputError for indices out of range and for
/// edges with several triangles on one side.
/// Source: G. Voronoi, J. reine angew. Math. 134 (1908); F. Aurenhammer, ACM Comput. Surv. 23 (1991).
LAMINA_EXPORT VoronoiDiagram voronoi_diagram(std::span<const Point> points, std::span<const Triangle> triangles);

/// Convex polygons in one array.
struct VoronoiCells {
    std::vector<std::uint32_t> starts{
        0};                        ///< cell i begins at corners[starts[i]] and ends before corners[starts[i + 1]]
    std::vector<Point> corners{};  ///< counter-clockwise in each cell

    /// Returns the number of cells.
    std::size_t size() const { return starts.size() - 1; }
    /// Returns the corners of cell i.
    std::span<const Point> operator[](std::size_t i) const {
        return std::span(corners).subspan(starts[i], starts[i + 1] - starts[i]);
    }
};

/// Returns the part of each Voronoi cell that lies in a convex polygon; empty where none does. Together the cells cover
/// the polygon. Each is cut from the polygon by the bisectors to the neighbours of its point, so cells that are open, or
/// whose corners lie far away, are as precise as others. Points that lie on one line, which have no triangles, have
/// cells, too. Points that are in no triangle though there are triangles have none. Takes O(d^2) for a point with d
/// neighbours, on all threads. Precondition: as for voronoi_diagram(). Throws as it does, and InputError for a polygon
/// that is not convex and counter-clockwise, for fewer than three corners, and for coordinates outside the exact range.
LAMINA_EXPORT VoronoiCells clipped_voronoi_cells(std::span<const Point> points, std::span<const Triangle> triangles,
                                                 std::span<const Point> polygon);

}  // namespace lamina
