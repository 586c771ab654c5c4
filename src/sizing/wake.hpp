// Wakes as sources of the size field.
#pragma once

#include <string>
#include <vector>

#include "sizing/requests.hpp"

namespace lamina::sizing {

/// A straight line from a trailing edge.
struct Wake {
    Point from, direction;  ///< the direction is a unit vector
    double length;          ///< in units of the input
};

/// Returns one wake from each trailing edge. Its length is the requested one, or that up to the first wall in its way.
std::vector<Wake> find_wakes(const SizedBodies& bodies, const WakeOptions& options);

/// Returns the sources along a wake whose size is `size` at the trailing edge.
std::vector<SizeSource> wake_sources(const Wake& wake, double size, double gradation);

/// Returns the sources along the wakes of one line from each trailing edge if the options give the size there, and none
/// otherwise.
std::vector<SizeSource> given_wake_sources(const WakeOptions& options, const SizedBodies& bodies, double gradation);

/// Reads "ANGLE[:LENGTH[:SIZE]]", where ANGLE may be "auto". Throws UsageError with the bare reason.
WakeOptions parse_wake(const std::string& text);
/// Returns the text that parse_wake() reads back.
std::string wake_text(const WakeOptions& wake);

}  // namespace lamina::sizing
