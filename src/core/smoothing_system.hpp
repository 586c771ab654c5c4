// Smoothing cubic splines.
// Source: C. H. Reinsch, Smoothing by spline functions, Numer. Math. 10 (1967); C. de Boor, A Practical Guide to
// Splines (1978), chapter 14.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::core {

/// The linear system of a smoothing spline with one penalty per point (penalty over weight). The spline g minimises sum
/// |g_i - p_i|^2 / penalty_i + integral |g''|^2. Its second derivatives c at the inner points satisfy (R + Q'PQ) c =
/// Q'p, and g = p - PQ c, where R is tridiagonal, Q has three bands, and P is the diagonal of the penalties. A penalty
/// of 0 holds a point where it is.
class SmoothingSystem {
public:
    SmoothingSystem(std::span<const Point> points, std::span<const double> t) : points_(points) {
        for (std::size_t i = 0; i + 1 < t.size(); ++i) h_.push_back(t[i + 1] - t[i]);
    }

    /// Returns the values of the spline at the points.
    std::vector<Point> solve(std::span<const double> penalty) const {
        const std::size_t n = points_.size(), m = n - 2;
        // The banded symmetric matrix, as its diagonal and two bands beside it, and later its factors L D L'.
        std::vector<std::array<double, 3>> band(m, std::array<double, 3>{});
        std::vector<Point> c(m);
        for (std::size_t j = 0; j < m; ++j) {
            band[j][0] = (h_[j] + h_[j + 1]) / 3;
            if (j + 1 < m) band[j][1] = h_[j + 1] / 6;
            for (std::size_t k = 0; k < 3 && j + k < m; ++k) band[j][k] += product(j, j + k, penalty);
            c[j] = (1 / h_[j + 1]) * (points_[j + 2] - points_[j + 1]) - (1 / h_[j]) * (points_[j + 1] - points_[j]);
        }
        for (std::size_t j = 0; j < m; ++j) {
            const std::array<double, 3> row = band[j];
            for (std::size_t k = 1; k < 3 && j + k < m; ++k) {
                const double factor = row[k] / row[0];
                for (std::size_t l = k; l < 3; ++l) band[j + k][l - k] -= factor * row[l];
                c[j + k] = c[j + k] - factor * c[j];
            }
        }
        for (std::size_t j = m; j-- > 0;) {
            for (std::size_t k = 1; k < 3 && j + k < m; ++k) c[j] = c[j] - band[j][k] * c[j + k];
            c[j] = (1 / band[j][0]) * c[j];
        }
        std::vector<Point> smooth(points_.begin(), points_.end());
        for (std::size_t j = 0; j < m; ++j)
            for (std::size_t row = j; row < j + 3; ++row)
                smooth[row] = smooth[row] - penalty[row] * entry(row, j) * c[j];
        return smooth;
    }

private:
    std::span<const Point> points_;
    std::vector<double> h_;  ///< chord length from each point to the next

    /// Returns Q(row, j) for row from j to j + 2.
    double entry(std::size_t row, std::size_t j) const {
        if (row == j) return 1 / h_[j];
        if (row == j + 2) return 1 / h_[j + 1];
        return -1 / h_[j] - 1 / h_[j + 1];
    }
    /// Returns (Q'PQ)(j, k) for k from j to j + 2.
    double product(std::size_t j, std::size_t k, std::span<const double> penalty) const {
        double sum = 0;
        for (std::size_t row = k; row < j + 3; ++row) sum += penalty[row] * entry(row, j) * entry(row, k);
        return sum;
    }
};

}  // namespace lamina::core
