// The sources of the size field that shorten the edges of borders.
#pragma once

#include <span>
#include <vector>

#include "sizing/requests.hpp"

namespace lamina::sizing {

/// Returns the sources that request edges of the loops to be shorter than they are, or nearly so, in the order of the
/// edges that each of them exceeds most. A source allows an edge the length share x size + gradation x distance.
/// Precondition: the sources are points.
std::vector<SizeSource> binding_sources(std::span<const SizeSource> sources, Loops loops, double gradation,
                                        double share);

}  // namespace lamina::sizing
