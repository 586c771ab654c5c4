// Coordinates as whole multiples of a step that is a small share of the cells round each vertex: far away it is coarse,
// and beside a wall fine.
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::page {

/// The step at a vertex is at most 2^-step_bits of the smallest height of its cells, so that no coordinate moves by
/// more than half of that.
inline constexpr int step_bits = 16;
/// But it is never less than 2^-coordinate_bits of the largest coordinate, where whole numbers in doubles end.
inline constexpr int coordinate_bits = 49;

/// Returns for each vertex the e for which its step is 2^e. Precondition: all indices are in range, and coordinates are
/// finite.
std::vector<std::int16_t> step_exponents(const Mesh& mesh);

/// Returns the multiple of 2^exponent that is nearest to x, as a whole number. Exact.
double steps_in(double x, int exponent);

}  // namespace lamina::page
