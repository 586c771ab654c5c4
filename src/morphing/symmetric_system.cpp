// Source: P. R. Amestoy, T. A. Davis, I. S. Duff, An approximate minimum degree ordering algorithm, SIAM J. Matrix
// Anal. Appl. 17 (1996), and T. A. Davis, Direct Methods for Sparse Linear Systems (2006), section 4.8, both as in
// Eigen.
#include "morphing/symmetric_system.hpp"

#include <cassert>
#include <utility>

#include <Eigen/SparseCholesky>

#include <lamina/error.hpp>

#include "core/text.hpp"

namespace lamina::morphing {

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Returns the matrix, and takes the memory of the entries back.
Matrix matrix_of(std::size_t n, std::vector<Entry> entries) {
    struct Triplet {
        const Entry* entry;
        const Triplet* operator->() const { return this; }
        const Triplet& operator*() const { return *this; }
        int row() const { return static_cast<int>(entry->row); }
        int col() const { return static_cast<int>(entry->column); }
        double value() const { return entry->value; }
        Triplet& operator++() { return ++entry, *this; }
        bool operator!=(const Triplet& other) const { return entry != other.entry; }
    };
    Matrix matrix(static_cast<int>(n), static_cast<int>(n));
    matrix.setFromTriplets(Triplet{entries.data()}, Triplet{entries.data() + entries.size()});
    return matrix;
}

}  // namespace

struct SymmetricSystem::Factors : Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> {
    explicit Factors(const Matrix& matrix) : SimplicialLDLT(matrix) {
        if (info() != Eigen::Success) throw MeshError("cells of the mesh are too flat for a field to be found on it");
    }

    /// The entries of L below its diagonal of ones, by columns; the diagonal of D; and the row of each unknown in both.
    const Matrix& lower() const { return m_matrix; }
    const Eigen::VectorXd& diagonal() const { return m_diag; }
    const Eigen::VectorXi& places() const { return m_P.indices(); }
};

SymmetricSystem::SymmetricSystem() = default;
SymmetricSystem::SymmetricSystem(SymmetricSystem&&) noexcept = default;
SymmetricSystem& SymmetricSystem::operator=(SymmetricSystem&&) noexcept = default;
SymmetricSystem::~SymmetricSystem() = default;

SymmetricSystem::SymmetricSystem(std::size_t n, std::vector<Entry> entries) {
    // Factors of fields on meshes have 52 entries a row at 78,000 rows, and more as the logarithm of the rows: 2^24 rows keep
    // them below the 2^31 that Eigen's numbers hold.
    constexpr std::size_t max_rows = std::size_t{1} << 24;
    if (n > max_rows)
        throw MeshError(core::concat("a mesh to morph has at most ", max_rows, " vertices beyond its rays, not ", n));
    if (n > 0) factors_ = std::make_unique<const Factors>(matrix_of(n, std::move(entries)));
}

std::vector<Row> SymmetricSystem::solve(std::span<const Row> right) const {
    if (!factors_) return {};
    const auto n = static_cast<int>(right.size());
    assert(n == factors_->lower().cols());
    const int* const first = factors_->lower().outerIndexPtr();
    const int* const row = factors_->lower().innerIndexPtr();
    const double* const value = factors_->lower().valuePtr();
    std::vector<Row> x(right.size()), solution(right.size());
    for (int i = 0; i < n; ++i) x[factors_->places()[i]] = right[i];
    for (int j = 0; j < n; ++j)
        for (int e = first[j]; e < first[j + 1]; ++e)
            for (std::size_t k = 0; k < 4; ++k) x[row[e]][k] -= value[e] * x[j][k];
    for (int j = n; j-- > 0;) {
        Row sum = x[j];
        for (double& number : sum) number /= factors_->diagonal()[j];
        for (int e = first[j]; e < first[j + 1]; ++e)
            for (std::size_t k = 0; k < 4; ++k) sum[k] -= value[e] * x[row[e]][k];
        x[j] = sum;
    }
    for (int i = 0; i < n; ++i) solution[i] = x[factors_->places()[i]];
    return solution;
}

}  // namespace lamina::morphing
