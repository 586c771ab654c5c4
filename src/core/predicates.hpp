// Exact predicates for hot loops: the floating-point filters are inline, the exact stages stand in predicates.cpp.
// Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, Discrete &
// Computational Geometry 18 (1997).
#pragma once

#include <cmath>

#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina::core {

/// Half an ulp of 1.
inline constexpr double epsilon = 0x1p-53;

/// The bounds of the filters: a rounded determinant has the right sign where its magnitude exceeds the bound times the
/// permanent. The permanent is the same expression with every product replaced by its magnitude and every difference of
/// products by their sum.
inline constexpr double orient2d_bound = (3 + 16 * epsilon) * epsilon;
inline constexpr double incircle_bound = (10 + 96 * epsilon) * epsilon;
inline constexpr double flattened_turn_bound = (9 + 96 * epsilon) * epsilon;

/// Returns orient2d() where its filter could not decide.
LAMINA_EXPORT double orient2d_after_filter(Point a, Point b, Point c);

/// Returns incircle_perturbed() where its filter could not decide: by the adaptive and exact stages, then the tie rule.
LAMINA_EXPORT double incircle_after_filter(Point a, Point b, Point c, Point d);

/// Returns flattened_turn() where its filter could not decide.
LAMINA_EXPORT double flattened_turn_after_filter(Point a, Point b, Point c, double cut);

/// Returns a number > 0 if a is farther from p than b, < 0 if nearer, and 0 if both are equally far. Only the sign is
/// exact.
LAMINA_EXPORT double compare_distances(Point p, Point a, Point b);

/// Returns orient2d(), inline.
inline double inline_orient2d(Point a, Point b, Point c) {
    const double left = (a.x - c.x) * (b.y - c.y);
    const double right = (a.y - c.y) * (b.x - c.x);
    const double det = left - right;
    // Where both products are 0, as on lines parallel to an axis, so is the determinant, exactly.
    if (std::abs(det) >= orient2d_bound * (std::abs(left) + std::abs(right))) return det;
    return orient2d_after_filter(a, b, c);
}

/// Returns whether a quadrilateral is counter-clockwise and turns to the left at each of its corners. Exact.
inline bool is_convex(Point a, Point b, Point c, Point d) {
    return inline_orient2d(a, b, c) > 0 && inline_orient2d(b, c, d) > 0 && inline_orient2d(c, d, a) > 0 &&
           inline_orient2d(d, a, b) > 0;
}

/// The rounded determinant of incircle(), and its permanent.
struct RoundedIncircle {
    double det, permanent;
    /// Returns whether the determinant has the right sign.
    bool certain() const { return std::abs(det) > incircle_bound * permanent; }
};

inline RoundedIncircle rounded_incircle(Point a, Point b, Point c, Point d) {
    const Point ad = a - d, bd = b - d, cd = c - d;
    const double bc = bd.x * cd.y, cb = cd.x * bd.y;
    const double ca = cd.x * ad.y, ac = ad.x * cd.y;
    const double ab = ad.x * bd.y, ba = bd.x * ad.y;
    const double a_lift = squared_length(ad), b_lift = squared_length(bd), c_lift = squared_length(cd);
    const double det = a_lift * (bc - cb) + b_lift * (ca - ac) + c_lift * (ab - ba);
    const double permanent = (std::abs(bc) + std::abs(cb)) * a_lift + (std::abs(ca) + std::abs(ac)) * b_lift +
                             (std::abs(ab) + std::abs(ba)) * c_lift;
    return {det, permanent};
}

/// Returns incircle_perturbed(), inline.
inline double inline_incircle_perturbed(Point a, Point b, Point c, Point d) {
    const RoundedIncircle rounded = rounded_incircle(a, b, c, d);
    if (rounded.certain()) return rounded.det;
    return incircle_after_filter(a, b, c, d);
}

/// Returns how the images of a, b, c turn that are lifted to the paraboloid whose axis stands at x = cut and then
/// projected along x: the image of (x, y) is (y, (x - cut)^2 + y^2). The result is > 0 if the image of b is below the
/// line through those of a and c, < 0 if above, and 0 if on it. Only the sign is exact.
/// Precondition: a.y < b.y < c.y.
inline double flattened_turn(Point a, Point b, Point c, double cut) {
    // Heights are relative to that of a, and y to a.y. This adds a linear function of y to the heights, which changes
    // no turn. The difference of the squares across the cut is written as a product.
    const double a_to_cut = a.x - cut, b_to_cut = b.x - cut, c_to_cut = c.x - cut;
    const double by = b.y - a.y, cy = c.y - a.y;
    const double bx = b.x - a.x, cx = c.x - a.x;
    const double left = by * (cx * (c_to_cut + a_to_cut) + cy * cy);
    const double right = cy * (bx * (b_to_cut + a_to_cut) + by * by);
    const double det = left - right;
    const double permanent = by * (std::abs(cx) * (std::abs(c_to_cut) + std::abs(a_to_cut)) + cy * cy) +
                             cy * (std::abs(bx) * (std::abs(b_to_cut) + std::abs(a_to_cut)) + by * by);
    if (std::abs(det) > flattened_turn_bound * permanent) return det;
    return flattened_turn_after_filter(a, b, c, cut);
}

}  // namespace lamina::core
