// Parts of Ansys Fluent's mesh format that its writer and its reader share. Sources: Ansys, "Mesh File Format"
// (appendix of the user's guide); what OpenFOAM's fluentMeshToFoam, VTK's vtkFLUENTReader and meshio read.
//
// A file is a list of sections in parentheses, each with its number first: 2 the dimension, 10 nodes, 12 cells, 13
// faces, 45 (or 39) the type and the name of a zone. A header says which nodes, cells or faces of which zone follow;
// zone 0 declares how many there are in all. Numbers in headers and lists are hexadecimal and count from 1, but those
// of zones in section 45 are decimal. A face of a plane mesh is the edge from node n0 to node n1, with the cell c0 on
// its left and c1 on its right; 0 stands for the outside. A cell has a shape, and its nodes follow from its faces.
//
// A binary section has the number 3010 (doubles) or 2010 (floats), 2012, 2013: its header in ASCII, a parenthesis with
// the numbers right behind it (integers of 4 bytes), and a line that ends it. Section 4 tells the order of the bytes.
#pragma once

#include <array>

#include <lamina/mesh.hpp>

namespace lamina::io {

enum FluentSection : int {
    fluent_dimension = 2,
    fluent_machine = 4,
    fluent_nodes = 10,
    fluent_cells = 12,
    fluent_faces = 13,
    fluent_zone_of_case = 39,
    fluent_zone = 45,
    fluent_cell_tree = 58,
    fluent_face_tree = 59,
    fluent_floats = 2000,  ///< added to the number of a section for binary floats and integers
    fluent_doubles = 3000  ///< added to the number of a section for binary doubles
};

enum FluentShape : int { fluent_mixed = 0, fluent_edge = 2, fluent_triangle = 1, fluent_quad = 3 };

/// The first number of section 4 where the bytes of a number are stored from the lowest on.
inline constexpr int fluent_little_endian = 60;

/// A type of a zone of faces.
struct FluentZoneType {
    int code;
    const char* name;
    MarkerKind kind;
};

inline constexpr FluentZoneType fluent_interior{2, "interior", MarkerKind::other};
inline constexpr FluentZoneType fluent_wall{3, "wall", MarkerKind::wall};
inline constexpr FluentZoneType fluent_pressure_outlet{5, "pressure-outlet", MarkerKind::far_field};
inline constexpr FluentZoneType fluent_symmetry{7, "symmetry", MarkerKind::symmetry};
inline constexpr FluentZoneType fluent_far_field{9, "pressure-far-field", MarkerKind::far_field};
inline constexpr FluentZoneType fluent_velocity_inlet{10, "velocity-inlet", MarkerKind::far_field};

/// The types whose kind is known.
inline constexpr std::array fluent_zone_types{fluent_wall,
                                              fluent_pressure_outlet,
                                              fluent_symmetry,
                                              fluent_far_field,
                                              fluent_velocity_inlet,
                                              FluentZoneType{4, "pressure-inlet", MarkerKind::far_field},
                                              FluentZoneType{20, "mass-flow-inlet", MarkerKind::far_field},
                                              FluentZoneType{36, "outflow", MarkerKind::far_field},
                                              FluentZoneType{37, "axis", MarkerKind::symmetry}};

}  // namespace lamina::io
