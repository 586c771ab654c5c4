// Measures of outlines for the tests of the surface stage.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/surface.hpp>

#include "support/geometry_fixtures.hpp"
#include "support/shapes.hpp"
#include "surface/corners.hpp"

namespace lamina {

using shapes::Outline;

inline constexpr double to_degrees = 180 / 3.14159265358979323846;

inline SurfaceOptions resampling(double max_turning_deg = 5) {
    SurfaceOptions options;
    options.treatment = SurfaceTreatment::resample;
    options.max_turning_deg = max_turning_deg;
    return options;
}

inline Element prepared(const Outline& outline, const SurfaceOptions& options) {
    const Geometry result = prepare_surfaces(shapes::geometry({outline}), options);
    EXPECT_NO_THROW(check_simple(result));
    return result.elements[0];
}

inline double max_spacing_ratio(const Outline& p) {
    double ratio = 1;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double before = distance(p[(i + p.size() - 1) % p.size()], p[i]),
                     after = distance(p[i], p[(i + 1) % p.size()]);
        ratio = std::max({ratio, before / after, after / before});
    }
    return ratio;
}

/// Returns the largest turning of the vertices that turn by less than `corner_deg`.
inline double max_turning_deg(const Outline& p, double corner_deg = 45) {
    double largest = 0;
    for (double t : surface::turning_angles(p))
        if (std::abs(t) * to_degrees < corner_deg) largest = std::max(largest, std::abs(t) * to_degrees);
    return largest;
}

inline double max_edge_length(const Outline& p) {
    double longest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) longest = std::max(longest, distance(p[i], p[(i + 1) % p.size()]));
    return longest;
}

inline bool contains(const Outline& outline, Point p) {
    return std::find(outline.begin(), outline.end(), p) != outline.end();
}

inline double distance_to(const Outline& outline, Point p) {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point a = outline[i], along = outline[(i + 1) % outline.size()] - a;
        const double t = std::clamp(dot(p - a, along) / squared_length(along), 0.0, 1.0);
        least = std::min(least, distance(p, a + t * along));
    }
    return least;
}

/// Returns the largest distance of the vertices and the middles of the edges from an exact outline.
inline double max_distance_from(const Outline& exact, const Outline& outline) {
    double farthest = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        farthest = std::max(farthest, distance_to(exact, outline[i]));
        farthest = std::max(farthest, distance_to(exact, midpoint(outline[i], outline[(i + 1) % outline.size()])));
    }
    return farthest;
}

/// Returns half the thickness of a NACA section at x, with this last coefficient.
inline double naca_half_thickness(double thickness, double x, double last = -0.1036) {
    return 5 * thickness * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 + x * last))));
}

inline void expect_equal_loops(const Outline& a, const Outline& b) {
    ASSERT_EQ(a.size(), b.size());
    const auto nearest =
        std::min_element(b.begin(), b.end(), [&](Point p, Point q) { return distance(p, a[0]) < distance(q, a[0]); });
    const auto shift = static_cast<std::size_t>(nearest - b.begin());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(distance(a[i], b[(i + shift) % b.size()]), 1e-11) << i;
}

}  // namespace lamina
