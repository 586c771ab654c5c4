// The kinds of markers, which are the named parts of the boundary of a mesh, and their names. A marker keeps its name
// through every file: patches of OpenFOAM, markers of SU2, physical groups of Gmsh, nodes of CGNS, families of FUN3D.
//
// Guarantees:
//  1. legal_marker_name() returns a legal name, and a legal name unchanged.
// Example:
//     assert(legal_marker_name("0012", MarkerKind::wall) == "wall_0012");  // no format takes a digit in front
//     assert(legal_marker_name("slat", MarkerKind::wall) == "slat" && !may_be_wall(MarkerKind::far_field));
#pragma once

#include <cstdint>
#include <string>

#include <lamina/export.hpp>

namespace lamina {

/// The boundary condition that a marker is meant for.
enum class MarkerKind : std::uint8_t {
    wall,       ///< the flow sticks to it
    far_field,  ///< the outer boundary
    symmetry,   ///< a line of symmetry
    other,      ///< unknown
    periodic,   ///< one of the two borders between blades of a row: the flow goes on at the other
    internal    ///< a line inside the domain, with cells on both sides: no boundary
};

/// Returns whether a marker of this kind counts as a wall: unless it is a far field, a symmetry or periodic.
constexpr bool may_be_wall(MarkerKind kind) { return kind == MarkerKind::wall || kind == MarkerKind::other; }

/// Returns the name that lamina gives a marker of this kind in place of one that not every format, solver and shell
/// takes (docs/reference/formats.md, "Names of markers"). A legal name stays.
LAMINA_EXPORT std::string legal_marker_name(const std::string& name, MarkerKind kind);

}  // namespace lamina
