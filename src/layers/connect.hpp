// The layer's points joined ray by ray and layer by layer; internal to the program.
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/layers.hpp>

namespace lamina::layers {

/// What becomes of a cell of the grid with four corners.
enum class GridCells {
    split,  ///< two triangles
    whole,  ///< a quadrilateral, where it is strictly convex and the border does not divide its top
};

/// The grid of rays and layers: between two neighbouring rays a column of as many cells as both have layers; below it a
/// triangle where they have one origin, above it a triangle where one has a layer more. A cell on the outer border,
/// whose points divide its top, is cut into triangles that fan from its lower corners (a divided triangle above a
/// column together with the cell below it). Of all such cuts, as of the two diagonals of a cell, one is taken whose
/// largest angle is smallest, of these the one with the fewest large angles beside it; where cuts are equal (within
/// 1e-6, more than rounding) the lower corner on the ray of the lexicographically smaller origin (of the smaller
/// direction, where rays have one origin) gets the diagonal or the larger fan. Every cell is positive, exactly, and its
/// corners lie on two neighbouring layers.
///
/// Precondition: check_layer() finds nothing wrong with the layer. Parallel; the result does not depend on the number
/// of threads. Cells are listed ray by ray, from the wall outwards. Criterion: I. Babuska, A. K. Aziz, On the angle
/// condition in the finite element method, SIAM J. Numer. Anal. 13 (1976): interpolation suffers from large angles, not
/// from small ones.
LayerCells connect_layer(const Layer& layer, GridCells cells);

}  // namespace lamina::layers
