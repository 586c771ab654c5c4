// The check of one piece of a mesh by the thread that has made it, while it lies in the cache. The code that makes the
// piece hands over which triangles are neighbours; this is verified, and nothing is taken for granted.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "core/edge_links.hpp"
#include "mesh/check_cells.hpp"

namespace lamina::mesh {

/// Isotropic triangles that are linked to their neighbours. Their vertices are the border vertices, which other pieces
/// may share, then the inner ones.
struct LinkedPiece {
    std::span<const Point> border;          ///< coordinates of the border vertices
    std::span<const VertexId> border_ids;   ///< their ids in the mesh
    std::span<const Point> inner;           ///< coordinates of the inner vertices
    std::span<const Triangle> triangles;    ///< counter-clockwise
    std::span<const core::EdgeLink> links;  ///< their neighbours; no_link on the border
    std::span<const Point> shared_points;   ///< coordinates of the shared vertices of the mesh, by their ids
};

/// A triangle below the bound on angles, between no frozen edges that enclose a sharp angle.
struct NarrowTriangle {
    std::size_t cell = 0;  ///< its number: in its piece at first, then in the mesh
    Point corners[3]{};
    /// The ids of the ends of its shortest edge, where both are border vertices: the outline of the region may excuse
    /// it then.
    std::optional<Segment> shortest{};
};

/// An edge without a neighbour in its piece, the piece on its left.
struct PieceBorderEdge {
    VertexId a, b;                 ///< ids in the mesh
    Point apex;                    ///< the third vertex of the triangle
    std::uint8_t shape_class = 0;  ///< as shape_class_behind() where the apex is not known
};

/// Stands for the apex of a triangle that nothing is known of.
inline constexpr Point unknown_apex{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// Returns a number up to 15 for the triangle (a, b, apex): 0 where its angle at the apex may be obtuse or where its
/// area is far from that of the equilateral triangle over the edge, else one of 15 classes of the ratio of the two
/// areas.
LAMINA_EXPORT std::uint8_t shape_class_behind(Point a, Point b, Point apex);
/// Return bounds of the ratio of the areas on both sides of an edge that have these classes, the larger over the
/// smaller one. Where neither is 0, the edge is Delaunay; where one is, the bounds are infinite and 1.
LAMINA_EXPORT double largest_area_ratio(std::uint8_t one, std::uint8_t other);
LAMINA_EXPORT double least_area_ratio(std::uint8_t one, std::uint8_t other);
/// Returns the area of the triangle behind an edge.
inline double area_over(Point a, Point b, Point apex) { return 0.5 * cross(b - a, apex - a); }

/// The cell of a piece that is the worst in some way; the first of several.
struct WorstCell {
    double badness = -HUGE_VAL;
    Point middle{};
};

/// All that the check of a mesh needs to know of one piece.
struct PieceFindings {
    std::size_t triangles = 0, inner_vertices = 0;
    std::size_t inner_edges = 0;          ///< edges between two of its triangles
    CellsSummary cells;                   ///< shapes, areas of neighbours, inner edges that violate Delaunay, defects
    std::vector<NarrowTriangle> narrow;   ///< in ascending order
    std::vector<PieceBorderEdge> border;  ///< in the order of the triangles
    /// The ids of its border vertices. A line that dangles in the piece has triangles on both sides, which are
    /// neighbours: not all border vertices are ends of border edges.
    std::vector<VertexId> border_vertices;
    WorstCell widest, narrowest;  ///< by the largest angle in degrees, and by minus the smallest one

    explicit PieceFindings(double min_angle_deg = 0) : cells(min_angle_deg) {}
};

/// Checks one piece exactly: all indices are in range, border vertices lie where the mesh has them, every vertex has a
/// triangle, triangles are counter-clockwise, and links join edges with the same ends in pairs, one in each direction.
/// The sum of the triangles as chains is then the sum of the border edges: whether these enclose the domain once is
/// decided for all pieces together. Measures what check_mesh() measures.
LAMINA_EXPORT PieceFindings check_piece(const LinkedPiece& piece, double min_angle_deg);

}  // namespace lamina::mesh
