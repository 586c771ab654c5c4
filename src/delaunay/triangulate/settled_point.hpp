// Places of new vertices that rounding errors do not change.
//
// A new vertex is computed from others, and circles through three of them enlarge rounding errors a thousand times and
// more. From row to row they would grow until they decide which fronts meet. In symmetric meshes they decide at once,
// since the mirror images of two vertices lie on a circle with them. So vertices that are placed for the size of a
// triangle are rounded to a lattice that is fine beside h: the same region in another unit, or with other last bits,
// gets the same vertices, and the same triangles. Points of a lattice have distances and circles in common more often
// than others, so each is moved aside by some steps, as its place on the lattice decides (docs/decisions/0062).
#pragma once

#include <bit>
#include <cstdint>

#include <lamina/point.hpp>

#include "core/random.hpp"
#include "core/rounding.hpp"

namespace lamina::delaunay {

/// Returns a point within 0.003 h of p, the same for nearly all points that differ from p by a rounding error.
/// Precondition: coordinates and h are multiples of a length that belongs to the problem, h is positive, and p is not
/// farther than 1e12 h from the origin.
inline Point settled_point(Point p, double h) {
    const double step = 0x1p-12 * core::power_of_two_below(h);
    const Point q = core::rounded_to_multiples(p, step);
    const auto steps = [&](double coordinate) { return std::bit_cast<std::uint64_t>(coordinate / step); };
    const std::uint64_t bits = core::splitmix64(core::splitmix64(steps(q.x)) + steps(q.y));
    const auto steps_aside = [](std::uint64_t four_bits) { return static_cast<double>(four_bits) - 7.5; };
    return q + step * Point{steps_aside(bits & 15u), steps_aside(bits >> 4 & 15u)};
}

}  // namespace lamina::delaunay
