// The space behind a blunt base.
#pragma once

#include <span>

#include <lamina/layers.hpp>

#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns the core between a base and the point `end` behind it. Its layers grow from the base by the law, until they
/// are as high as an edge of the wake is long. The first edge has the length `edge`; each one after that is longer by
/// `ratio`. Precondition: base holds two points or more, from the right to the left of the flow.
WakeCore make_core(std::size_t element, std::span<const Point> base, Point end, double edge, double ratio,
                   const LayerGrowth& growth);

}  // namespace lamina::layers
