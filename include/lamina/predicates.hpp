// Exact geometric predicates: the sign is always right.
// Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates,
// Discrete & Computational Geometry 18 (1997).
#pragma once

#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// Predicates are exact for coordinates that are zero or have a magnitude in [smallest, largest]: then no product of
/// four differences over- or underflows. Input outside is refused by in_exact_range() checks at every entrance.
inline constexpr double smallest_exact_coordinate = 1e-60;
inline constexpr double largest_exact_coordinate = 1e60;

/// False for NaN and infinities, too.
constexpr bool in_exact_range(Point p) {
    const auto in_range = [](double c) {
        const double magnitude = c < 0 ? -c : c;
        // No branches: whole arrays are asked about.
        return (magnitude == 0) | ((magnitude >= smallest_exact_coordinate) & (magnitude <= largest_exact_coordinate));
    };
    return in_range(p.x) & in_range(p.y);
}

/// > 0 if a, b, c turn counter-clockwise, < 0 if clockwise, 0 if collinear. Only the sign is exact.
LAMINA_EXPORT double orient2d(Point a, Point b, Point c);

/// > 0 if d lies inside the circle through a, b, c (counter-clockwise), < 0 outside, 0 on it. Only the sign is exact.
LAMINA_EXPORT double incircle(Point a, Point b, Point c, Point d);

/// incircle() with the one tie rule of the program: the lifted height of each point is lowered infinitesimally, the
/// lexicographically smallest point most. Never 0 for four distinct points of which a, b, c are not collinear; every
/// empty cocircular polygon is thus fanned from its smallest vertex, whatever routine asks and in whatever order.
LAMINA_EXPORT double incircle_perturbed(Point a, Point b, Point c, Point d);

}  // namespace lamina
