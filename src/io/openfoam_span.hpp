// The thickness of meshes of OpenFOAM.
#pragma once

namespace lamina::io {

/// The thickness of OpenFOAM's meshes, which are one cell thick, in units of the mesh.
inline constexpr double openfoam_span = 1;

}  // namespace lamina::io
