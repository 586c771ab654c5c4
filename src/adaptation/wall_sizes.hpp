// The spacings of walls that a solution asks for.
#pragma once

#include <span>
#include <vector>

#include <lamina/solution.hpp>
#include <lamina/solution_sizes.hpp>

#include "adaptation/error_norm.hpp"
#include "adaptation/wall_flow.hpp"

namespace lamina::adaptation {

/// One number per edge of each wall.
using EdgeValues = std::vector<double>;

/// The edges beside one of a wall, and differences along the wall there.
class EdgesBeside {
public:
    EdgesBeside(const WallFlow& wall, std::size_t edge);
    /// Returns the second derivative of values at the middles of the three edges.
    double second_derivative(double at_before, double here, double at_after) const;

    std::size_t before, after;

private:
    double back_, ahead_;  ///< distances of the middles
};

/// Returns means over each edge and those beside it; edges at corners do not count, and have the mean of the others.
EdgeValues means_of_three(const WallFlow& wall, const EdgeValues& values);

/// Returns the second derivatives along walls that fields ask for, where those of each field beyond the walls are
/// multiplied by its scale; the largest of all fields counts. Those of a field are means in the p-norm over the cells
/// of the layer above an edge: a shock, whose front ends within the boundary layer, bends little on the wall. Friction,
/// which is no field of the region beyond, gets as many edges as the fields do.
std::vector<EdgeValues> wall_curvatures(const Solution& solution, const std::vector<WallFlow>& walls,
                                        std::span<const double> scales, const ErrorNorm& norm);

/// Makes spacings of walls that cost and gain as much as sizes beyond the layer do. A column of N layers with the
/// height H and the width h has N / h vertices and an error of H c (lambda h^2)^p per unit of the wall, where lambda is
/// the second derivative along it, a mean over all heights. Beyond the layer there are 1 / (a h^2) vertices and an
/// error of c' (lambda h^2)^p per unit of area. A last vertex gains the same in both where
///   h_wall^(2 p + 1) = factor^(2 p + 2) a c' N / (2 c H lambda^p)   and   h = factor lambda^(-p / (2 p + 2)).
/// Source: A. Loseille, F. Alauzet, SIAM J. Numer. Anal. 49 (2011), with the heights of cells given.
class WallSizes {
public:
    WallSizes(std::vector<WallFlow> walls, std::vector<EdgeValues> curvatures, const ErrorNorm& norm,
              double max_change);

    /// Returns walls for sizes of this factor.
    std::vector<SizedWall> with(double factor) const;

private:
    std::vector<WallFlow> walls_;
    std::vector<EdgeValues> spacing_;  ///< per wall and edge: that with factor 1; infinite where lambda is 0
    double of_factor_;                 ///< spacings are multiplied by this power of the factor
    double max_change_;
};

}  // namespace lamina::adaptation
