// Dense systems of linear equations.
#pragma once

#include <span>
#include <vector>

namespace lamina::flow {

/// Returns x with A x = b for a square matrix, given row by row, and each of the right sides b. Elimination with
/// partial pivoting. The result has the same bits on every machine and any number of threads, whatever the other right
/// sides are; it is not finite where the matrix is singular. Precondition: there is a right side.
std::vector<std::vector<double>> solve_dense(std::vector<double> matrix,
                                             std::span<const std::vector<double>> right_sides);

}  // namespace lamina::flow
