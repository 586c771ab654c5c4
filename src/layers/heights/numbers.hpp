// Numbers of layers on columns of which each may have several.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layers/heights/stretch.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

// Rows of cells between neighbouring rays, and how far they are from rectangles.

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

/// The upper end of a column.
struct ColumnEnd {
    double height;            ///< of the front, along the ray
    double last_spacing;      ///< height of the last layer with the number that is wanted
    std::uint32_t wanted;     ///< number of layers
    LayerRange layers;        ///< numbers of layers with which a stretch can keep the front where it is
    double spacing_of_least;  ///< height of the last layer with the least number
    double spacing_of_most;   ///< height of the last layer with the largest number
};

/// Returns the cheapest numbers of layers within the ranges of these ends, one per ray.
std::vector<std::uint32_t> cheapest_numbers(const RaySet& set, std::span<const ColumnEnd> ends);

}  // namespace lamina::layers
