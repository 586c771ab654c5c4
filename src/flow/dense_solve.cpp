// Eigen adds products in an order that depends on the width of the processor's vectors and on the number of threads,
// unless it is told to use neither. Within one block of its elimination, whose depth is at most 256, sums are not split
// by the size of a cache either: a split would need a first-level cache of less than 12 kB.
#define EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_PARALLELIZE
#define EIGEN_MPL2_ONLY

#include "flow/dense_solve.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

namespace lamina::flow {

std::vector<double> solve_dense(std::vector<double> matrix, std::span<const double> right_side) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto n = static_cast<Eigen::Index>(right_side.size());
    const Eigen::MatrixXd by_columns = Eigen::Map<const RowMajor>(matrix.data(), n, n);
    matrix = {};
    std::vector<double> solution(right_side.size());
    Eigen::Map<Eigen::VectorXd>(solution.data(), n) =
        by_columns.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(right_side.data(), n));
    return solution;
}

}  // namespace lamina::flow
