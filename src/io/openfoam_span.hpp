// The thickness of meshes of OpenFOAM, and of others in space.
#pragma once

namespace lamina::io {

/// The thickness of meshes in space, in units of the mesh, unless a span is given.
inline constexpr double openfoam_span = 1;
/// The angle of the wedge in degrees that a mesh round an axis becomes.
inline constexpr double foam_wedge_deg = 2.5;

}  // namespace lamina::io
