// The deflection of a plain flap.
#pragma once

#include <vector>

#include <lamina/geometry.hpp>

#include "geometry/source_point.hpp"

namespace lamina::geometry {

/// Returns the outline with its rear deflected as FlapDeflection says, beginning at the rearmost vertex. Neighbours of
/// the new vertices are left out where they are so close to them, and so little off the new edges, that they would only
/// disturb the spacing. The corners that it makes are marked. `element` names the section in messages. Throws
/// InputError, with the place, where the flap cannot be deflected. Precondition: the outline is simple and
/// counter-clockwise.
std::vector<SourcePoint> with_deflected_flap(const std::vector<SourcePoint>& outline, const FlapDeflection& flap,
                                             const Element& element);

}  // namespace lamina::geometry
