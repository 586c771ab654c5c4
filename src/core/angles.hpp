// Angles between directions, with the same bits on every machine.
#pragma once

#include <lamina/point.hpp>

#include "core/reproducible_math.hpp"

namespace lamina::core {

/// Returns the angle from one direction to another in (-pi, pi], positive counter-clockwise. The directions may have
/// any length but 0.
inline double angle_between(Point from, Point to) { return atan2_reproducible(cross(from, to), dot(from, to)); }

/// Returns the direction turned counter-clockwise by an angle in radians.
inline Point rotated(Point a, double angle) {
    const double c = cos_reproducible(angle), s = sin_reproducible(angle);
    return {a.x * c - a.y * s, a.x * s + a.y * c};
}

}  // namespace lamina::core
