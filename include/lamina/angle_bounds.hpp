// Bounds on the smallest angle of isotropic triangles.
#pragma once

namespace lamina {

/// The smallest angle, in degrees, up to which Delaunay refinement is proved to end: arcsin(1 / (2 sqrt 2)), rounded.
/// The default wherever an angle bound is asked for. Source: J. Ruppert, J. Algorithms 18 (1995), theorem 1.
inline constexpr double proved_min_angle_deg = 20.7;

/// The largest bound that refinement accepts. Between the proved bound and this one refinement has always ended in
/// trials, but may leave triangles below the bound, which are counted (docs/decisions/0002).
inline constexpr double max_min_angle_deg = 33;

}  // namespace lamina
