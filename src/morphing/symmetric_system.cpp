// Source: P. R. Amestoy, T. A. Davis, I. S. Duff, An approximate minimum degree ordering algorithm, SIAM J. Matrix Anal.
// Appl. 17 (1996), and T. A. Davis, Direct Methods for Sparse Linear Systems (2006), section 4.8, both as in Eigen.
#include "morphing/symmetric_system.hpp"

#include <cassert>

#include <Eigen/SparseCholesky>

namespace lamina::morphing {

SymmetricSystem::SymmetricSystem(std::size_t n, std::span<const Entry> entries) {
    using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
    if (n == 0) return;
    std::vector<Eigen::Triplet<double, int>> triplets;
    triplets.reserve(entries.size());
    for (const Entry& entry : entries)
        triplets.emplace_back(static_cast<int>(entry.row), static_cast<int>(entry.column), entry.value);
    Matrix matrix(static_cast<int>(n), static_cast<int>(n));
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    triplets = {};
    const Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> factors(matrix);
    assert(factors.info() == Eigen::Success);
    const auto& order = factors.permutationP().indices();
    place_.assign(order.data(), order.data() + n);
    const auto triangle = factors.matrixL();
    const Matrix& lower = triangle.nestedExpression();
    first_.assign(lower.outerIndexPtr(), lower.outerIndexPtr() + n + 1);
    row_.assign(lower.innerIndexPtr(), lower.innerIndexPtr() + first_.back());
    value_.assign(lower.valuePtr(), lower.valuePtr() + first_.back());
    const Eigen::VectorXd diagonal = factors.vectorD();
    diagonal_.assign(diagonal.data(), diagonal.data() + n);
}

std::vector<Row> SymmetricSystem::solve(std::span<const Row> right) const {
    const std::size_t n = size();
    assert(right.size() == n);
    std::vector<Row> x(n);
    for (std::size_t i = 0; i < n; ++i) x[place_[i]] = right[i];
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t e = first_[j]; e < first_[j + 1]; ++e)
            for (std::size_t k = 0; k < 4; ++k) x[row_[e]][k] -= value_[e] * x[j][k];
    for (std::size_t j = n; j-- > 0;) {
        Row& row = x[j];
        for (double& number : row) number /= diagonal_[j];
        for (std::size_t e = first_[j]; e < first_[j + 1]; ++e)
            for (std::size_t k = 0; k < 4; ++k) row[k] -= value_[e] * x[row_[e]][k];
    }
    std::vector<Row> solution(n);
    for (std::size_t i = 0; i < n; ++i) solution[i] = x[place_[i]];
    return solution;
}

}  // namespace lamina::morphing
