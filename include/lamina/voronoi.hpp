// Voronoi diagrams: for each point the part of the plane that is nearer to it than to any other.
//
// Guarantees:
//  1. The graph is exact: which centre is a corner of which cell follows from the triangles. Centres are rounded.
//  2. Clipped cells together cover the polygon, and open or far-reaching ones are as precise as others.
//  3. Results are the same on any number of threads.
// Limits:
//  1. The triangles are what triangulate(points) returns. InputError for indices out of range and for edges with
//     several triangles on one side. Points that are in no triangle though there are triangles have no cells.
// Example:
//     const std::vector<Point> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, frame{{-1, -1}, {3, -1}, {3, 3}, {-1, 3}};
//     const std::vector<Triangle> triangles = triangulate(points).triangles;
//     assert(voronoi_diagram(points, triangles).corners[0] == (Point{1, 1}));
//     const VoronoiCells cells = clipped_voronoi_cells(points, triangles, frame);
//     assert(cells.size() == 4 && cells[0].size() == 4);  // four squares
//
// Source: G. Voronoi, J. reine angew. Math. 134 (1908); F. Aurenhammer, ACM Comput. Surv. 23 (1991).
#pragma once

#include <lamina/delaunay_connectivity.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// An edge of a Voronoi diagram that runs to infinity, between the cells of two neighbours on the hull.
struct VoronoiRay {
    VertexId a;           ///< the hull edge that it crosses at right angles, or would, begins here
    VertexId b;           ///< ... and ends here; the hull is on its left
    TriangleId triangle;  ///< the triangle at that edge, whose centre the ray starts from
    Point direction;      ///< away from the hull, as long as the edge
};

/// A Voronoi diagram.
struct VoronoiDiagram {
    /// The centre of the circle through the corners of each triangle. They are rounded.
    std::vector<Point> corners;
    /// For each point the corners of its cell, counter-clockwise, by the indices of the triangles. Cells on the hull
    /// are open: they lie between a ray to their first corner and one from their last.
    IndexLists cells;
    std::vector<VoronoiRay> rays;  ///< one for each edge of the hull, in the order of boundary_loops()
};

/// Returns the Voronoi diagram of points in O(n).
LAMINA_EXPORT VoronoiDiagram voronoi_diagram(std::span<const Point> points, std::span<const Triangle> triangles);

/// Convex polygons in one array: cell i begins at corners[starts[i]] and ends before corners[starts[i + 1]].
struct VoronoiCells {
    std::vector<std::uint32_t> starts{0};  ///< one for each cell, then the end
    std::vector<Point> corners{};          ///< counter-clockwise in each cell

    std::size_t size() const { return starts.size() - 1; }  ///< the number of cells
    /// Returns the corners of cell i.
    std::span<const Point> operator[](std::size_t i) const {
        return std::span(corners).subspan(starts[i], starts[i + 1] - starts[i]);
    }
};

/// Returns the part of each Voronoi cell that lies in a convex polygon; empty where none does. Each is cut from the
/// polygon by the bisectors to the neighbours of its point. Points that lie on one line, which have no triangles, have
/// cells, too. Takes O(d^2) for a point with d neighbours. Throws InputError for a polygon that is not convex and
/// counter-clockwise, for fewer than three corners, and for coordinates outside the exact range.
LAMINA_EXPORT VoronoiCells clipped_voronoi_cells(std::span<const Point> points, std::span<const Triangle> triangles,
                                                 std::span<const Point> polygon);

}  // namespace lamina
