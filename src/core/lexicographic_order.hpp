// The order of points by x and then by y, for sorted containers.
#pragma once

#include <lamina/point.hpp>

namespace lamina::core {

/// The order of lexicographically_less() as a type.
struct LexicographicOrder {
    bool operator()(Point a, Point b) const { return lexicographically_less(a, b); }
};

}  // namespace lamina::core
