// Exact geometric predicates: the sign of the result is always right.
// Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, Discrete &
// Computational Geometry 18 (1997).
#pragma once

#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The predicates are exact for coordinates that are 0 or whose magnitude lies in [min_exact_coordinate,
/// max_exact_coordinate]: no product of four differences of them over- or underflows. Every entry into the library
/// refuses other coordinates by in_exact_range().
inline constexpr double min_exact_coordinate = 1e-60;
/// Upper end of the range that begins at min_exact_coordinate.
inline constexpr double max_exact_coordinate = 1e60;

/// Returns whether both coordinates are 0 or in the range of exact predicates; false for NaN and infinities.
constexpr bool in_exact_range(Point p) {
    const auto in_range = [](double c) {
        const double magnitude = c < 0 ? -c : c;
        // Operators without branches, since whole arrays are tested.
        return (magnitude == 0) | ((magnitude >= min_exact_coordinate) & (magnitude <= max_exact_coordinate));
    };
    return in_range(p.x) & in_range(p.y);
}

/// Returns a number > 0 if a, b, c turn counter-clockwise, < 0 if clockwise, and 0 if they are collinear. Only the sign
/// is exact.
LAMINA_EXPORT double orient2d(Point a, Point b, Point c);

/// Returns a number > 0 if d lies inside the circle through a, b, c, < 0 if outside, and 0 if on it, where a, b, c run
/// counter-clockwise; the opposite where they run clockwise. Only the sign is exact.
LAMINA_EXPORT double incircle(Point a, Point b, Point c, Point d);

/// Returns incircle(), with ties broken by the one tie rule of the program: each point is lifted to the paraboloid
/// x^2 + y^2 and its height lowered by an infinitesimal; that of the lexicographically smallest point outweighs all
/// others. The result is never 0 for four distinct points of which a, b, c are not collinear. Every empty cocircular
/// polygon is thus fanned from its smallest vertex, whatever function asks and in whatever order.
LAMINA_EXPORT double incircle_perturbed(Point a, Point b, Point c, Point d);

}  // namespace lamina
