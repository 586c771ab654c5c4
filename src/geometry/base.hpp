// The base of a blunt trailing edge.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <lamina/point.hpp>

namespace lamina {

/// The two corners of a base, in the order of the outline.
struct Base {
    std::size_t first, last;
};

/// A straight base at the downstream end of a closed counter-clockwise outline: two convex corners of 45 to 135 degrees
/// with nothing but straight edges between them, shorter than half of the body and in its rear half. Of several the
/// rearmost.
std::optional<Base> find_base(std::span<const Point> outline);

}  // namespace lamina
