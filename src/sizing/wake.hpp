// Wakes as sources of the size field.
#pragma once

#include <vector>

#include <lamina/sizing.hpp>

namespace lamina::sizing {

/// A straight line from a trailing edge.
struct Wake {
    Point from, direction;  ///< unit vector
    double length;
};

/// Returns one wake from each trailing edge, as long as asked for or up to the first wall.
std::vector<Wake> find_wakes(const SizedBodies& bodies, const WakeOptions& options);

/// Returns the sources along a wake whose size is `size` at the trailing edge.
std::vector<SizeSource> wake_sources(const Wake& wake, double size, double gradation);

/// Returns the sources along all wakes whose size at the trailing edge is given; none where it is not.
std::vector<SizeSource> given_wake_sources(const SizingOptions& options, const SizedBodies& bodies);

}  // namespace lamina::sizing
