// Boxes inside the far field, for the rings of the decoupling.
#pragma once

#include <optional>

#include <lamina/decoupling.hpp>
#include <lamina/export.hpp>

namespace lamina::decoupling {

/// Returns the outermost box of the rings: the far field itself where it is a box, otherwise a square about the centre
/// of 0.8 times the size of the largest one that fits in.
Box inscribed_box(const FarField& far_field);

/// Returns whether the far field encloses the bodies at a distance of a hundredth of their extent.
LAMINA_EXPORT bool leaves_room(const FarField& far_field, const Box& bodies);

/// Returns the near-body box, which stands half the extent of `bodies` away from them, inside the outermost box.
/// Returns nothing where the far field leaves little room, because rings between boxes so near to each other would have
/// sharp corners. Throws OptionError unless leaves_room().
std::optional<Box> near_body_box(const Box& bodies, const Box& outermost, const FarField& far_field);

}  // namespace lamina::decoupling
