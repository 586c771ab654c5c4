// Curved cells as files hold them: with one list of points, vertices and nodes of cells together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <lamina/curved_mesh.hpp>

#include "mesh/adjacency.hpp"

namespace lamina::io {

/// Returns the order of a line, triangle or quadrilateral with so many nodes; 0 where no order up to max_cell_order has
/// them.
unsigned order_of_cell(unsigned corners, std::size_t nodes);

/// Returns what a reader of straight cells says.
std::string curved_cells_refused(unsigned order);

/// Tells the nodes of curved cells from vertices. Before, all are points of the mesh, and the lists of nodes number
/// these; afterwards they are as CurvedNodes says. Returns false where a node is the corner of one cell and no corner
/// of another.
bool separate_nodes(CurvedMesh& mesh);

/// Does what orient_markers() does, with the nodes of edges, and what separate_nodes() does where cells are curved.
bool orient_and_separate(CurvedMesh& mesh);

/// Returns the places in the order of CurvedNodes of the nodes of a Lagrange quadrilateral in that of VTK, which runs
/// along the last two edges from their far ends, and through the inner nodes row by row. Lines and triangles have one
/// order in both. Source: VTK, vtkHigherOrderQuadrilateral.
std::vector<std::size_t> vtk_order_of_quad(unsigned order);

/// Returns the directed edges that no cell before theirs has, ascending: cells number their edges so as they are met.
std::vector<std::uint32_t> edges_as_first_met(const MeshView& mesh, const mesh::Adjacency& adjacency);

/// Returns the places of the nodes of a cell with 3 or 4 corners in the order of CurvedNodes, where those from `first`
/// on are sorted by their rows, of which the first edge is the first one.
std::vector<std::size_t> rows_of_nodes(unsigned corners, unsigned order, std::size_t first);

}  // namespace lamina::io
