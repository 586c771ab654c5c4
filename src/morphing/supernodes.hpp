// The order in which the unknowns of a sparse symmetric system are eliminated, and where its factor has entries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/SparseCore>

namespace lamina::morphing {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

inline constexpr std::uint32_t no_supernode = std::numeric_limits<std::uint32_t>::max();

/// The columns of a factor in groups, the supernodes. Those of one have entries in the same rows below the last of
/// them, and in all rows of the group, so that dense matrices hold them. Each stands before its parent, which the first
/// row below it is a column of, and after all other supernodes of its subtree.
struct Supernodes {
    std::vector<std::uint32_t> place;      ///< per unknown: its column
    std::vector<std::uint32_t> first;      ///< per supernode: its first column; and the number of columns at the end
    std::vector<std::size_t> first_below;  ///< per supernode: its first row in `below`, and the end
    std::vector<std::uint32_t> below;      ///< rows below the columns, in ascending order
    std::vector<std::uint32_t> parent;     ///< no_supernode for the last one of a connected part

    std::size_t size() const { return parent.size(); }
    std::size_t columns(std::size_t s) const { return first[s + 1] - first[s]; }
    std::span<const std::uint32_t> rows_below(std::size_t s) const {
        return std::span(below).subspan(first_below[s], first_below[s + 1] - first_below[s]);
    }
};

/// Finds an order with few entries, and its supernodes. The entries of the matrix on and below the diagonal are given;
/// all of the diagonal are there.
Supernodes find_supernodes(const Matrix& lower);

/// Returns the entries on and below the diagonal of the matrix with its unknowns in the order of the columns.
Matrix reordered(const Matrix& lower, std::span<const std::uint32_t> place);

}  // namespace lamina::morphing
