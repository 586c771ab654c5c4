// Normal smoothing: rays are tilted from the bisectors so that they do not meet in concavities.
#pragma once

#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/outline_kind.hpp"
#include "layers/wake_outline.hpp"

namespace lamina::layers {

/// Vertices that turn by more than this are corners. They are few, and the rays beside them need their rays to tilt.
inline constexpr double max_smooth_turning_deg = 6;

/// Largest angle between a tilted ray and the normals of the edges at its origin, in degrees.
inline constexpr double max_angle_from_normal_deg = 50;

/// Largest angle between a ray that leans so that columns widen and the normals of the edges at its origin, in degrees: cells
/// in all rows at the wall are as skewed as that.
inline constexpr double max_lean_from_normals_deg = 57;

/// A vertex of an outline with the outward normals round it.
struct WallVertex {
    double turning;       ///< angle between the two edges in radians; > 0 where the body is convex
    Point normal_before;  ///< outward unit normal of the edge that ends here
    Point normal_after;   ///< outward unit normal of the edge that begins here
    Point bisector;       ///< outward unit vector
    bool fan;             ///< whether it has several rays, from normal_before to normal_after; else one, the bisector
    double tilt[2]{};     ///< angles by which the first and the last ray are tilted, in radians, counter-clockwise
};

/// Returns the angle from the last ray of a vertex to the first one of the next, counter-clockwise, in radians.
double angle_to_next(const WallVertex& vertex, const WallVertex& next);

/// Returns the largest tilt of the one ray of a vertex, in radians, at which it is higher above one of the edges at its
/// origin than above the other by no more than twice 0.009 of their mean. `turning` is that of the vertex, in radians.
double max_tilt_between_edges(double turning);

/// Sets the tilts of the vertices. Convex and gently turning walls get none. On short edges corners of one ray are spread
/// until neighbouring rays differ by no more than max_angle, in radians; not at all where it is pi. On smooth outlines the
/// rays of short faces diverge (short_faces.hpp), and fans beside them lean as far as these.
void smooth_normals(std::span<const RayVertex> outline, const LayerGrowth& growth, double max_angle, OutlineKind kind,
                    std::vector<WallVertex>& vertices);

}  // namespace lamina::layers
