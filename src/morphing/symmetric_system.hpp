// Sparse symmetric positive definite systems that are factored once and solved for many right-hand sides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace lamina::morphing {

/// The numbers that one unknown or one right-hand side holds: two complex numbers.
using Row = std::array<double, 4>;

/// An entry of a matrix. Entries of the same place are added in the order in which they are given.
struct Entry {
    std::uint32_t row, column;
    double value;
};

/// The factors L D L' of a matrix, by which right-hand sides are solved one row of four at a time.
class SymmetricSystem {
public:
    SymmetricSystem();  ///< has no rows
    /// Factors a matrix of n rows, of which the entries on and below the diagonal are given. Throws MeshError where it
    /// is not positive definite, as on cells that are nearly flat, and for more rows than have numbers.
    SymmetricSystem(std::size_t n, std::vector<Entry> entries);
    SymmetricSystem(SymmetricSystem&&) noexcept;
    SymmetricSystem& operator=(SymmetricSystem&&) noexcept;
    ~SymmetricSystem();

    /// Returns the solution. Precondition: there is a right-hand side for each row of the matrix.
    std::vector<Row> solve(std::span<const Row> right) const;

private:
    struct Factors;
    std::unique_ptr<const Factors> factors_;  ///< null where there are no rows
};

}  // namespace lamina::morphing
