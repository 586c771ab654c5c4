// Dense systems of linear equations.
#pragma once

#include <span>
#include <vector>

namespace lamina::flow {

/// Returns x with A x = b for a square matrix, given row by row. Elimination with partial pivoting. The result has the
/// same bits on every machine and any number of threads; it is not finite where the matrix is singular.
std::vector<double> solve_dense(std::vector<double> matrix, std::span<const double> right_side);

}  // namespace lamina::flow
