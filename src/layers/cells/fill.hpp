// The cells between walls and outer borders, made with a record of the threads' times.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "core/busy_times.hpp"
#include "delaunay/pieces/pieces.hpp"
#include "layers/layer.hpp"

namespace lamina::layers {

// The columns of cells between neighbouring rays, with the stretches of the outer border that bound them.

/// The cells between two neighbouring rays; `second` follows counter-clockwise round the element.
struct CellColumn {
    const Ray &first, &second;
    std::span<const VertexId> top;  ///< the outer border from the tip of `first` to that of `second`
    /// The stretches of the outer border that run along the rays: up `first` from its origin, and down `second`. The
    /// border does so where the column on the other side of the ray is empty and the ray has one layer; elsewhere the
    /// stretch is empty.
    std::span<const VertexId> up, down;
};

/// The columns of one element.
class CellColumns {
public:
    /// Makes the columns of this element of a layer. Keeps a reference to its rays.
    CellColumns(const Layer& layer, std::size_t element);

    /// Returns the number of columns: that of the rays, and one less on an outer wall.
    std::size_t size() const { return rays_.size() - is_open_; }

    /// Returns the column between ray i and the next one.
    CellColumn operator[](std::size_t i) const;

private:
    std::span<const Ray> rays_;
    bool is_open_;
    /// The outer border, through the tips of all rays, those inside closed clefts included. The first vertex stands at
    /// its end again.
    std::vector<VertexId> border_;
    std::vector<std::size_t> tip_;  ///< index of each tip in the border; at the end that of the first one again

    std::span<const VertexId> border_between_tips(std::size_t i) const;
    bool border_runs_along(std::size_t bare, std::size_t ray) const;
};

/// Does what fill_layer() does and adds the times of the threads to `times`, unless that is null. The kinds of work are
/// those of delaunay::pieces::PieceWork.
LAMINA_EXPORT LayerCells fill(const Layer& layer, LayerTopology topology, const DecompositionOptions& options,
                              core::BusyTimes* times);

/// Returns the constrained Delaunay triangulation of the layer's points between walls and outer borders, in pieces.
LAMINA_EXPORT delaunay::pieces::PiecewiseTriangulation triangulate_layer(const Layer& layer,
                                                                         const DecompositionOptions& options = {},
                                                                         core::BusyTimes* times = nullptr);

// The points of the layer joined as a grid, ray by ray and layer by layer.

/// The form of a cell of the grid that has four corners.
enum class GridCells {
    split,  ///< two triangles
    /// A quadrilateral, where it is strictly convex and the border does not divide its top; else triangles.
    whole,
};

/// Returns the cells of the grid of rays and layers. Between two neighbouring rays stands a column of as many cells as
/// both rays have layers, and above it a triangle where one ray has a layer more. The lowest cell is a triangle where
/// the two have one origin. A cell on the outer border, where division points lie on its top, is cut into triangles;
/// a divided triangle above a column is cut together with the cell below it.
///
/// Between cuts, and between the two diagonals of a cell, the angles decide, the largest ones before all
/// (PolygonCutter::cut()). Where cuts are equal, the lower corner on the ray of the
/// lexicographically smaller origin gets the diagonal or the larger fan; if both rays have one origin, the smaller
/// direction decides. Every cell is positive (exact), and its corners lie on two neighbouring layers.
///
/// Precondition: check_layer() finds nothing wrong with the layer. Parallel; the result does not depend on the number
/// of threads. Cells are listed ray by ray, from the wall outwards. Criterion: I. Babuska, A. K. Aziz, On the angle
/// condition in the finite element method, SIAM J. Numer. Anal. 13 (1976): interpolation suffers from large angles, not
/// from small ones.
///
/// LayerCells::grid_refused says that a cell cannot be cut into positive triangles. Then none of the cells is of use.
LayerCells connect_layer(const Layer& layer, GridCells form);

}  // namespace lamina::layers
