// Bounds on the smallest angle of isotropic triangles.
#pragma once

namespace lamina {

/// The smallest angle, in degrees, up to which Delaunay refinement is proved to end: arcsin(1 / (2 sqrt 2)), rounded.
/// It is the default of every angle bound. Source: J. Ruppert, J. Algorithms 18 (1995), theorem 1.
inline constexpr double proved_min_angle_deg = 20.7;

/// The largest bound, in degrees, that refinement accepts for the smallest angle. Between proved_min_angle_deg and this
/// bound refinement ended in all trials, but it may leave triangles below the bound, which are counted.
inline constexpr double max_min_angle_deg = 33;

}  // namespace lamina
