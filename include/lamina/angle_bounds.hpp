// Bounds on the smallest angle of isotropic triangles, in degrees.
#pragma once

namespace lamina {

/// Delaunay refinement is proved to end up to this angle: arcsin(1 / (2 sqrt 2)), rounded. It is the default of every
/// angle bound. Source: J. Ruppert, J. Algorithms 18 (1995), theorem 1.
inline constexpr double proved_min_angle_deg = 20.7;
/// The largest bound that refinement accepts. It has ended in all trials, but leaves smaller angles, which it counts.
inline constexpr double max_min_angle_deg = 33;

}  // namespace lamina
