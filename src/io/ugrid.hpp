// Parts of the UGRID format that its writer and its reader share. Sources: SimCenter UG_IO, "UGRID 3D grid file type"
// (order of the numbers, ordering of nodes); FUN3D manual, "Boundary conditions" (codes of the .mapbc).
//
// Plane files hold the nodes as x y 0, the triangles, the quadrilaterals, the number 1 for each of them, and then the
// boundary: the number of its edges, and two nodes and the number of the marker for each edge.
//
// Files for FUN3D hold a mesh in space in ASCII or binary (extrusion.hpp). The airfoil lies in planes of constant y,
// the first at y = 0. Prisms and hexahedra stand on the face with the higher y, whose normal points to the other.
// Normals of the boundary's faces point into the domain. Markers are numbered from 1 on; the first and the last plane
// follow.
//
// The .mapbc file beside either holds the number, the code and the name of each marker.
#pragma once

#include <filesystem>

namespace lamina::io {

/// Codes of boundary conditions in .mapbc files.
enum MapbcCode : int {
    mapbc_unknown = 0,
    mapbc_wall = 3000,
    mapbc_viscous_wall = 4000,
    mapbc_far_field = 5000,
    mapbc_periodic = 6100,
    mapbc_symmetry_x = 6661,
    mapbc_symmetry_y = 6662,
    mapbc_symmetry_z = 6663
};

enum class UgridEncoding { ascii, big_endian, little_endian };

/// Returns the encoding that the name of the file stands for: .b8.ugrid, .lb8.ugrid, or any other name.
UgridEncoding encoding_of(const std::filesystem::path& file);

/// Returns the name of the .mapbc file beside the file: "wing.mapbc" for "wing.b8.ugrid".
std::filesystem::path mapbc_of(const std::filesystem::path& file);

}  // namespace lamina::io
