// Notes for the user about the points of an element.
#pragma once

#include <cstddef>
#include <string>

#include <fmt/format.h>

#include <lamina/geometry.hpp>

namespace lamina::surface {

/// Returns "1 corner", "2 corners".
inline std::string counted(std::size_t n, const std::string& what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// Notes that the points zigzag about the curve they were read from, if they do.
void note_noise(Element& element);

/// Notes single points that stand off the curve of their neighbours. Many of them are the shape of the thing.
void note_misplaced(Element& element);

}  // namespace lamina::surface
