// Sparse symmetric positive definite systems that are factored once and solved for many right-hand sides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/export.hpp>

namespace lamina::morphing {

/// The numbers that one unknown or one right-hand side holds: two complex numbers.
using Row = std::array<double, 4>;

/// An entry of a matrix. Entries of the same place are added in the order in which they are given.
struct Entry {
    std::uint32_t row, column;
    double value;
};

/// The factors L D L' of a matrix.
class SymmetricSystem {
public:
    SymmetricSystem() = default;
    /// Factors a matrix of n rows, of which the entries on and below the diagonal are given.
    SymmetricSystem(std::size_t n, std::span<const Entry> entries);

    std::size_t size() const { return place_.size(); }
    /// Returns the solution.
    std::vector<Row> solve(std::span<const Row> right) const;

private:
    std::vector<std::uint32_t> place_;  ///< per unknown: its row in the factors
    std::vector<std::size_t> first_;    ///< per column of L: its first entry below the diagonal
    std::vector<std::uint32_t> row_;    ///< per entry: its row
    std::vector<double> value_;         ///< per entry: its value
    std::vector<double> diagonal_;      ///< D
};

}  // namespace lamina::morphing
