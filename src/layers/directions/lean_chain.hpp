// The leans of all rays of an outline as one convex problem on a chain.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lamina::layers {

/// Bounds of the lean of a ray, in radians.
struct LeanBounds {
    double least, most;
};

/// The solution, and what it took.
struct ChainLeans {
    std::vector<double> leans;  ///< one per ray, in radians, counter-clockwise
    std::size_t steps = 0;      ///< of Newton's method
};

/// The lack of width of a column at the front, over the front's height: the angles, in radians, by which its rays should
/// diverge more than they do without leans. A column that lacks nothing has any negative number, down to minus infinity.
struct ColumnLack {
    double wanted;  ///< for it to be as wide as columns should be
    double least;   ///< for its rays not to meet near the front
};

/// Returns the leans t within their bounds that minimise
///
///     sum weight (wanted - o)_+^2 + (least - o)_+^2 over columns  +  stiffness sum t^2 over rays,
///
/// where o = t_after - t_before is what the rays of a column diverge by. Column k lies between rays k and k + 1; the first ray
/// follows the last one. The function is strictly convex: there is one minimum, and mirrored input has mirrored leans but for
/// rounding. What is wanted is spread over about 1 / sqrt(stiffness) columns.
/// Each step costs O(n), since the Hessian is a cyclic tridiagonal M-matrix; a step that changes neither the terms that count
/// nor the leans that are held ends the search. Preconditions: at least three rays, one column and one pair of bounds for
/// each, least <= most, weight > 0, stiffness > 0.
/// Source: D. P. Bertsekas, Projected Newton methods for optimization problems with simple constraints, SIAM J. Control
/// Optim. 20 (1982), 221-246.
ChainLeans minimise_leans(std::span<const ColumnLack> lacks, std::span<const LeanBounds> bounds, double weight,
                          double stiffness);

}  // namespace lamina::layers
