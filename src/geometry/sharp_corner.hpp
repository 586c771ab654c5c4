// When a corner is sharp.
#pragma once

namespace lamina::geometry {

/// A convex vertex of an outline that turns by more than this many degrees is a sharp corner: a trailing edge, or a
/// corner of a blunt base.
inline constexpr double sharp_corner_deg = 60;

}  // namespace lamina::geometry
