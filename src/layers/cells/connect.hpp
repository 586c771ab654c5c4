// The points of the layer joined as a grid, ray by ray and layer by layer.
#pragma once

#include "layers/layer.hpp"

namespace lamina::layers {

/// The form of a cell of the grid that has four corners.
enum class GridCells {
    split,  ///< two triangles
    /// A quadrilateral, where it is strictly convex and the border does not divide its top; else triangles, and a
    /// quadrilateral on its lower edge where faces are more orthogonal with it.
    whole,
};

/// Returns the cells of the grid of rays and layers. Between two neighbouring rays stands a column of as many cells as
/// both rays have layers, and above it a triangle where one ray has a layer more. The lowest cell is a triangle where
/// the two have one origin. A cell on the outer border, where division points lie on its top, is cut into triangles
/// that fan from its lower corners; a divided triangle above a column is cut together with the cell below it.
///
/// Between cuts, and between the two diagonals of a cell, the angles decide: the largest one must be as small as
/// possible, and then the others (StripCutter::cut()). Where cuts are equal, the lower corner on the ray of the
/// lexicographically smaller origin gets the diagonal or the larger fan; if both rays have one origin, the smaller
/// direction decides. Every cell is positive (exact), and its corners lie on two neighbouring layers.
///
/// Precondition: check_layer() finds nothing wrong with the layer. Parallel; the result does not depend on the number
/// of threads. Cells are listed ray by ray, from the wall outwards. Criterion: I. Babuska, A. K. Aziz, On the angle
/// condition in the finite element method, SIAM J. Numer. Anal. 13 (1976): interpolation suffers from large angles, not
/// from small ones.
LayerCells connect_layer(const Layer& layer, GridCells form);

}  // namespace lamina::layers
