// Small systems of linear equations of fixed size.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace lamina::flow::coupled {

/// Rows of a system: coefficients first, then right sides.
template <std::size_t Unknowns, std::size_t Sides>
using SmallSystem = std::array<std::array<double, Unknowns + Sides>, Unknowns>;

/// Replaces the right sides by the solutions, by elimination with pivots of the columns. They are not finite where the
/// system is singular.
template <std::size_t Unknowns, std::size_t Sides>
void solve_small(SmallSystem<Unknowns, Sides>& rows) {
    for (std::size_t c = 0; c < Unknowns; ++c) {
        std::size_t pivot = c;
        for (std::size_t i = c + 1; i < Unknowns; ++i)
            if (std::abs(rows[i][c]) > std::abs(rows[pivot][c])) pivot = i;
        std::swap(rows[pivot], rows[c]);
        const double scale = 1 / rows[c][c];
        for (double& number : rows[c]) number *= scale;
        for (std::size_t i = 0; i < Unknowns; ++i) {
            const double factor = rows[i][c];
            if (i == c || factor == 0) continue;
            for (std::size_t j = c; j < Unknowns + Sides; ++j) rows[i][j] -= factor * rows[c][j];
        }
    }
}

}  // namespace lamina::flow::coupled
