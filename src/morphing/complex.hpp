// Points as complex numbers: a product turns and stretches, and its adjoint is the product with the conjugate.
#pragma once

#include <lamina/point.hpp>

namespace lamina::morphing {

/// Returns the product of two complex numbers.
constexpr Point product(Point a, Point b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

/// Returns the complex number mirrored in the real axis.
constexpr Point conjugate(Point a) { return {a.x, -a.y}; }

}  // namespace lamina::morphing
