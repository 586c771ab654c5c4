// Exact geometric predicates: questions about coordinates whose answer is a sign.
//
// Guarantees:
//  1. The sign is right, whatever the rounding, for coordinates that in_exact_range() accepts.
// Limits:
//  1. Only the sign means something, not the magnitude. Every entry into the library refuses other coordinates.
//  2. Arithmetic is IEEE's: neither -ffast-math nor contraction to fused operations (lamina's CMake targets see to it).
// Example:
//     const Point a{0, 0}, b{1, 0}, c{1, 1};
//     assert(orient2d(a, b, c) > 0 && orient2d(a, b, {2, 0}) == 0);        // a left turn; collinear
//     assert(incircle(a, b, c, {0, 1}) == 0 && incircle_perturbed(a, b, c, {0, 1}) != 0);  // a square
//
// Source: J. R. Shewchuk, Discrete & Computational Geometry 18 (1997), adaptive precision floating-point arithmetic.
#pragma once

#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// Smallest magnitude of a coordinate that is not 0: no product of four differences underflows.
inline constexpr double min_exact_coordinate = 1e-60;
/// Largest magnitude of a coordinate: no product of four differences overflows.
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

/// Returns a number > 0 if a, b, c turn counter-clockwise, < 0 if clockwise, and 0 if they are collinear.
LAMINA_EXPORT double orient2d(Point a, Point b, Point c);
/// Returns a number > 0 if d lies inside the circle through a, b, c, < 0 if outside, and 0 if on it, where a, b, c run
/// counter-clockwise; the opposite where they run clockwise.
LAMINA_EXPORT double incircle(Point a, Point b, Point c, Point d);
/// Returns incircle(), with ties broken by the one tie rule of lamina: each point is lifted to the paraboloid x^2 + y^2
/// and its height lowered by an infinitesimal; that of the lexicographically smallest point outweighs all others, so
/// that cocircular polygons are fanned from it. Never 0 for four distinct points of which a, b, c are not collinear.
LAMINA_EXPORT double incircle_perturbed(Point a, Point b, Point c, Point d);

}  // namespace lamina
