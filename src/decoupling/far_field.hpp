// The far field as the decoupling needs it.
#pragma once

#include <optional>

#include <lamina/decoupling.hpp>

namespace lamina::decoupling {

/// Returns the largest box about the centre that all but touches the far field; the far field itself where it is a box.
Box inscribed_box(const FarField& far_field);

/// Returns the near-body box, which stands half the extent of `bodies` away from it, inside the outermost box. Empty
/// where the far field leaves little room: rings between boxes so near would have sharp corners. Throws OptionError
/// where the far field does not enclose the bodies with some room.
std::optional<Box> near_body_box(const Box& bodies, const Box& outermost, const FarField& far_field);

}  // namespace lamina::decoupling
