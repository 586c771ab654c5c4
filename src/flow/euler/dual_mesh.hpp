// The median dual of a triangulation: one control volume round each vertex.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::flow::euler {

/// An edge of the triangulation and the face between the control volumes of its ends.
struct DualEdge {
    std::uint32_t i, j;  ///< its ends, i < j
    Point normal;        ///< from i to j, as long as the face
};

/// The condition at an edge of the boundary.
enum class BoundaryKind : std::uint8_t {
    wall,  ///< no gas passes
    base,  ///< the base of a blunt trailing edge, out of which gas flows
    far,   ///< the far field
};

/// An edge of the boundary.
struct BoundaryEdge {
    std::uint32_t a, b;  ///< its ends
    Point normal;        ///< out of the gas, as long as the edge
    BoundaryKind kind;
};

/// The median dual. Vertices are numbered anew, in the order of E. Cuthill and J. McKee (Proc. 24th Nat. Conf. ACM,
/// 1969), in which sweeps carry changes far.
struct DualMesh {
    std::vector<std::uint32_t> given;      ///< per vertex: its number in the triangulation
    std::vector<std::uint32_t> number_of;  ///< per vertex of the triangulation: its number here
    std::vector<Point> points;             ///< the vertices
    std::vector<double> areas;             ///< of the control volumes
    std::vector<DualEdge> edges;           ///< sorted by their ends
    std::vector<BoundaryEdge> boundary;    ///< in the order in which they were added
    /// The neighbours of vertex v are neighbours[k] for begins[v] <= k < begins[v + 1].
    std::vector<std::uint32_t> begins, neighbours;
    /// Per edge: the index k at which its end i has j as neighbour, and the one at which j has i.
    std::vector<std::array<std::uint32_t, 2>> places;
    /// Per vertex: the inverse of the symmetric matrix of least-squares gradients with weights 1 / length^2: xx, xy,
    /// yy.
    /// Source: T. J. Barth, AIAA-91-0721.
    std::vector<std::array<double, 3>> gradient_inverses;
};

/// Returns the dual of a triangulation, without its boundary, or an empty mesh where a vertex does not hang together
/// with the first one. `first` gets the number 0. Precondition: triangles are counter-clockwise.
DualMesh make_dual_mesh(std::span<const Point> points, std::span<const Triangle> triangles, VertexId first);

/// Adds an edge of the boundary, directed with the gas at its left.
void add_boundary_edge(DualMesh& mesh, Segment edge, BoundaryKind kind);

}  // namespace lamina::flow::euler
