// Curved cells of order 2 to 4: nodes beside the vertices of a mesh, and the proof that each cell is valid.
//
// Guarantees:
//  1. A cell counts as valid only where the determinant of its Jacobian is proved to be positive in all of it, by bounds of
//     its Bernstein coefficients that hold for the coordinates as they are, rounding errors included. Nothing is sampled.
//  2. Cells that share an edge share its nodes, and so do markers.
// Limits:
//  1. Whether curved edges of the boundary cross each other is not looked at. check_mesh() judges the straight mesh.
//  2. Cells so thin that rounding alone could turn them over, beyond ratios of some 1e9 to 1, count as not proved.
// Example:
//     const Mesh mesh{.points = {{0, 0}, {1, 0}, {0, 1}}, .triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}}};
//     CurvedNodes nodes{.order = 2, .points = {{0.5, -0.1}, {0.5, 0.5}, {0, 0.5}}};
//     nodes.triangle_nodes = {VertexId{3u}, VertexId{4u}, VertexId{5u}};
//     assert(check_curved(mesh, nodes).valid());
//     nodes.points[0].y = 0.3;  // the cell folds
//     assert(check_curved(mesh, nodes).invalid == 1);
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina {

inline constexpr unsigned max_cell_order = 4;  ///< the highest order of curved cells

/// The rule that places the nodes of a cell of order p on the straight cell. It has p + 1 places x_0 = 0 to x_p = 1
/// along an edge. Nodes of a square are at (x_i, x_j), and those of a triangle have the barycentric coordinates x_k, x_i and
/// x_j over their sum, where i + j + k = p. Up to order 2 both rules are the same.
enum class NodeDistribution : std::uint8_t {
    equidistant,   ///< x_i = i / p: MSH, VTU, CGNS and others
    gauss_lobatto  ///< the points of Gauss and Lobatto's quadrature: MFEM and Nektar++
};

/// The nodes of a mesh of higher order beside its vertices. Node i of these has the number mesh.points.size() + i. Each
/// cell is the image of a straight one by Lagrange's polynomials of its order, whose nodes are on the straight cell as
/// `distribution` says. Those beside its corners are listed edge by edge, from each corner to the next, then those
/// inside, which are ordered as the nodes of a smaller cell (the order of Gmsh):
///
///        order 2     order 3          order 4                order 3
///        2           2                2                      3--9--8--2
///        | .         | .              | .                    |        |
///        5  4        7  6             9  8                   10 15 14 7
///        |    .      |    .           |    .                 |        |
///        0--3--1     8  9  5          10 14  7               11 12 13 6
///                    |       .        |        .             |        |
///                    0--3--4--1       11 12 13  6            0--4--5--1
///                                     |           .
///                                     0--3--4--5---1
struct CurvedNodes {
    unsigned order = 1;                                             ///< 1: no nodes, the cells are straight
    NodeDistribution distribution = NodeDistribution::equidistant;  ///< where they are on the straight cell
    std::vector<Point> points{};                                    ///< the nodes
    std::vector<VertexId> triangle_nodes{};  ///< per triangle (order + 1) (order + 2) / 2 - 3 of them
    std::vector<VertexId> quad_nodes{};      ///< per quadrilateral (order + 1)^2 - 4
    std::vector<VertexId> marker_nodes{};    ///< per edge of all markers in a row, from its begin to its end: order - 1
};

/// A mesh with curved cells.
struct CurvedMesh {
    Mesh mesh{};          ///< the vertices, and cells with straight edges between them
    CurvedNodes nodes{};  ///< what makes them curved
};

/// The result of check_curved().
struct CurvedCheck {
    std::vector<MeshDefect> defects;  ///< the first 20; empty: all is proved
    std::size_t defect_count = 0;     ///< number of all defects
    std::size_t invalid = 0;          ///< cells that are proved to be invalid
    std::size_t unproved = 0;         ///< cells that are proved neither valid nor invalid
    /// Smallest over largest determinant in a cell, as bounded: the smallest ratio of all cells, and its 1st
    /// percentile.
    double min_scaled_jacobian = 0;
    Point min_scaled_jacobian_at{};  ///< a vertex of that cell
    double p01_scaled_jacobian = 0;  ///< the 1st percentile, within 0.01

    bool valid() const { return defect_count == 0; }  ///< whether all cells are proved valid
};

/// Proves each cell valid, and checks that lists are complete and cells with an edge in common have its nodes in
/// common. Parallel. Precondition: check_mesh() finds no defect of the arrays of the mesh. Source: A. Johnen, J.-F.
/// Remacle, C. Geuzaine, Geometrical validity of curvilinear finite elements, J. Comput. Phys. 233 (2013).
LAMINA_EXPORT CurvedCheck check_curved(const MeshView& mesh, const CurvedNodes& nodes);

/// How well curved cells follow walls.
struct CurvingSummary {
    std::size_t wall_edges = 0;    ///< edges of the walls of elements
    std::size_t curved_edges = 0;  ///< edges of walls whose nodes are on the curve of the wall
    /// Edges between curve and chord: those beside cells that were invalid, and those that were divided beside the
    /// curve, whose parts are straight.
    std::size_t reduced_edges = 0;
    double reduced_distance = 0;  ///< largest distance between such an edge and the curve, in units of the input
    double wall_distance = 0;     ///< largest distance of the others from it, halfway between nodes
    /// The smallest scaled Jacobian of the straight cells with the same corners, for comparison.
    double straight_min_scaled_jacobian = 1;
};

}  // namespace lamina
