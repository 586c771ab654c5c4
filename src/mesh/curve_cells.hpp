// Cells that follow curved walls, made from a mesh with straight ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/curved_mesh.hpp>

namespace lamina::mesh {

/// The curve that an edge of a wall stands for.
struct WallCurve {
    Segment edge;  ///< directed with the mesh on its left
    /// 2 p - 1 points of the curve from edge.a to edge.b, in half_step_on_edge(): each second one becomes a node.
    std::vector<Point> between;
};

/// The columns of cells over walls.
struct CellColumnNumbers {
    std::span<const std::uint32_t> columns;  ///< MeshResult::columns
    static constexpr std::uint32_t none = 0xffffffff;

    /// Returns the number of the column of a cell, or `none`.
    std::uint32_t of(const MeshView& mesh, std::size_t cell) const;
};

/// Nodes, how well they follow the walls, and the proof of the cells.
struct CurvedCells {
    CurvedNodes nodes;
    CurvingSummary summary;
    CurvedCheck check;  ///< without defects
};

/// The order of cells, and where their nodes are.
struct CellOrder {
    unsigned order = 1;
    NodeDistribution distribution = NodeDistribution::equidistant;
};

/// Makes the cells of a mesh curved cells of order p that follow the walls, and proves all of them valid. Parallel; the
/// result does not depend on the number of threads.
///
/// The bend d of a wall's edge, the distance between curve and chord at its nodes, goes up the column of cells over it.
/// A node at the share u along the column and the height h above the wall moves by (1 - h / H) d(u), where H is the
/// height of the column and of the first cell beyond it, which shares the bend by transfinite interpolation. Without a
/// column that is the wall's own cell. So the cells of a column are alike but for a factor, and what matters is the
/// bend against H rather than against the height of a cell: the derivative across the column changes by d / H, and that
/// along it by d'.
///
/// The bends of the edges that move a cell are halved, and become 0 after six times, where its scaled determinant, the
/// smallest one over the largest, cannot be proved to be 0.02 and is less than half of what it is when the cell is
/// straight. Cells that are not valid have 0. Throws MeshError where a cell is not valid even so. Precondition:
/// check_mesh() finds no defect; the edges are on the boundary, each given once; quadrilaterals at them are in columns.
LAMINA_EXPORT CurvedCells curve_cells(const MeshView& mesh, CellOrder order, std::span<const WallCurve> walls,
                                      const CellColumnNumbers& columns);

}  // namespace lamina::mesh
