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

std::vector<std::vector<double>> solve_dense(std::vector<double> matrix,
                                             std::span<const std::vector<double>> right_sides) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto n = static_cast<Eigen::Index>(right_sides.front().size());
    const Eigen::MatrixXd by_columns = Eigen::Map<const RowMajor>(matrix.data(), n, n);
    matrix = {};
    const auto factors = by_columns.partialPivLu();
    std::vector<std::vector<double>> solutions;
    for (const std::vector<double>& right_side : right_sides) {  // one at a time: Eigen adds blocks of them otherwise
        std::vector<double>& solution = solutions.emplace_back(right_side.size());
        Eigen::Map<Eigen::VectorXd>(solution.data(), n) =
            factors.solve(Eigen::Map<const Eigen::VectorXd>(right_side.data(), n));
    }
    return solutions;
}

}  // namespace lamina::flow
