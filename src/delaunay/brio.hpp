// In which order points are inserted into a triangulation.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "core/random.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

inline constexpr unsigned insertion_rounds = 16;

/// The random round in which the point of this number is inserted: three quarters of all points are in the last one,
/// three sixteenths in the one before, ...
inline unsigned insertion_round(Index point) {
    const std::uint64_t z = core::splitmix64(point);
    constexpr unsigned last = insertion_rounds - 1;
    return last - static_cast<unsigned>(std::countr_zero(z | 1ull << 2 * last)) / 2;
}

/// Biased randomised insertion order: rounds that grow by a factor of four, each sorted along a Hilbert curve.
/// A permutation of the indices of `points`, whose box is given; depends on the points alone.
std::vector<Index> insertion_order(std::span<const Point> points, const Box& box);

}  // namespace lamina::delaunay
