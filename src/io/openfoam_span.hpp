// The thickness of meshes of OpenFOAM, and of others in space.
#pragma once

namespace lamina::io {

/// The thickness of meshes in space, in units of the mesh, unless a span is given.
inline constexpr double openfoam_span = 1;
/// The marker of kind symmetry whose mesh becomes a wedge about y = 0, and the angle of the wedge in degrees.
inline constexpr const char* foam_axis = "axis";
inline constexpr double foam_wedge_deg = 2.5;

}  // namespace lamina::io
