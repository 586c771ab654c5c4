// The equilateral triangle, by which edge lengths and areas are translated into each other.
#pragma once

namespace lamina::core {

/// sqrt(3) / 4: area over squared edge.
inline constexpr double equilateral_area = 0.43301270189221932;

}  // namespace lamina::core
