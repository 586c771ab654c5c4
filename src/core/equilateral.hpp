// The equilateral triangle, by which edge lengths and areas are converted into each other.
#pragma once

namespace lamina::core {

/// The area of an equilateral triangle divided by its squared edge: sqrt(3) / 4.
inline constexpr double equilateral_area = 0.43301270189221932;

}  // namespace lamina::core
