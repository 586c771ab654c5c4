// Rows of cells between neighbouring rays, and how far they are from rectangles.
#pragma once

#include "layers/stages.hpp"

namespace lamina::layers {

/// A row between two neighbouring rays.
struct ColumnRow {
    double width;  ///< across the rays
    double rise;   ///< along the rays, from the first to the second
};

/// Returns the row between the points of two rays at these heights.
ColumnRow row_between(const RayLine& a, double height_a, const RayLine& b, double height_b);

/// Returns the tangent by which a row is off a right angle with its rays, at most 8: sums of such tangents are exact
/// enough for small ones.
double tangent_of(const ColumnRow& row);

/// Returns the skewness of the face, `height` long, that lies on the ray between two columns: the distance from the
/// middle of the face to the line between the middles of the cells on both sides, over half of its length; at most 8.
double skewness_between(const ColumnRow& before, const ColumnRow& after, double height);

}  // namespace lamina::layers
