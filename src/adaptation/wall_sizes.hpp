// The spacings of walls that a solution asks for.
#pragma once

#include <span>
#include <vector>

#include <lamina/solution.hpp>
#include <lamina/solution_sizes.hpp>

#include "adaptation/wall_flow.hpp"

namespace lamina::adaptation {

/// The mean square error of interpolating x^2 / 2 linearly between points 1 apart, and on equilateral triangles with edges of 1.
inline constexpr double square_error_on_line = 1.0 / 120, square_error_on_triangle = 3.375 / 720;

/// Makes spacings of walls that cost and gain as much as sizes beyond the layer do. A column of N layers with the height H and
/// the width h has N / h vertices and the mean square error H (c lambda h^2)^2 per unit of the wall, where lambda is the second
/// derivative along it, which is taken for the same at all heights. Beyond the layer there are 1 / (a h^2) vertices and an error
/// of (c' lambda h^2)^2 per unit of area. A last vertex gains the same in both where
///   h_wall^5 = factor^6 a c' N / (2 c H lambda^2)   and   h = factor lambda^(-1/3).
/// Source: A. Loseille, F. Alauzet, SIAM J. Numer. Anal. 49 (2011), with the heights of cells given.
class WallSizes {
public:
    /// scales: those by which the second derivatives of each field of the solution are multiplied, as beyond the layer.
    WallSizes(const Solution& solution, std::vector<WallFlow> walls, std::span<const double> scales, double max_change);

    /// Returns walls for sizes of this factor.
    std::vector<SizedWall> with(double factor) const;

private:
    std::vector<WallFlow> walls_;
    std::vector<std::vector<double>> curvature_;  ///< per wall and edge: the largest lambda of all fields
    double max_change_;
};

}  // namespace lamina::adaptation
