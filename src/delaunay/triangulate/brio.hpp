// BRIO, the biased randomised insertion order: random rounds of points, each sorted along a space-filling curve.
// Source: N. Amenta, S. Choi, G. Rote, Incremental constructions con BRIO, SoCG 2003.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "core/random.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// The number of random rounds.
inline constexpr unsigned brio_rounds = 16;

/// Returns the random round that the point of this number is inserted in. The last round holds three quarters of all
/// points, the one before it three sixteenths, and so on.
inline unsigned brio_round(Index point) {
    const std::uint64_t z = core::splitmix64(point);
    constexpr unsigned last = brio_rounds - 1;
    return last - static_cast<unsigned>(std::countr_zero(z | 1ull << 2 * last)) / 2;
}

/// Returns the indices of the points in BRIO: rounds that grow by a factor of four, each sorted along a Hilbert curve.
/// The order depends on the points alone. Precondition: `box` is the bounding box of the points.
std::vector<Index> brio_order(std::span<const Point> points, const Box& box);

}  // namespace lamina::delaunay
