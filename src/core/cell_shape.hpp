// The shape of one cell, and its measurement for triangles.
#pragma once

#include <algorithm>
#include <limits>
#include <numbers>

#include <lamina/point.hpp>

#include "core/reproducible_math.hpp"

namespace lamina::core {

/// Measures of the shape of a cell.
struct CellShape {
    double area = 0;
    double min_angle_deg = 0;
    double max_angle_deg = 0;
    double aspect_ratio = 0;  ///< of a triangle: longest edge over the height on it; of a quad: squared longest edge
                              ///< over area
    double mean_ratio = 0;    ///< 1 for the equilateral triangle and the square, 0 for flat cells
};

/// The shape of a cell without area.
inline constexpr CellShape flat_shape{0, 0, 180, std::numeric_limits<double>::infinity(), 0};

/// Returns the mean ratio of a triangle from twice its area and the sum of its squared edges.
constexpr double mean_ratio(double twice_area, double squared_edges) {
    return 2 * std::numbers::sqrt3 * twice_area / squared_edges;
}

/// Measures a counter-clockwise triangle, angles to 1e-12 degrees. A triangle whose area rounds to 0 or less gets
/// flat_shape.
inline CellShape measure_triangle(Point a, Point b, Point c) {
    const double twice_area = cross(b - a, c - a);
    if (!(twice_area > 0)) return flat_shape;
    const double bc = squared_length(c - b), ca = squared_length(a - c), ab = squared_length(b - a);
    const double longest = std::max(std::max(bc, ca), ab), shortest = std::min(std::min(bc, ca), ab);
    const double middle = std::max(std::min(bc, ca), std::min(std::max(bc, ca), ab));
    // By the law of cosines half of each sum below is the scalar product of the edges at the angle. Both angles are
    // acute, since they lie opposite the two shorter edges.
    const double smallest = degrees(first_quadrant_angle(twice_area, 0.5 * (longest + middle - shortest)));
    const double medium = degrees(first_quadrant_angle(twice_area, std::max(0.0, 0.5 * (longest + shortest - middle))));
    return {.area = 0.5 * twice_area,
            .min_angle_deg = std::max(0.0, smallest),
            .max_angle_deg = 180 - smallest - medium,
            .aspect_ratio = longest / twice_area,
            .mean_ratio = mean_ratio(twice_area, bc + ca + ab)};
}

}  // namespace lamina::core
