// The numbers of Gmsh for the types of elements. Source: Gmsh reference manual, "Gmsh mesh file formats".
#pragma once

namespace lamina::io {

enum MshElementType : int {
    msh_line = 1,
    msh_triangle = 2,
    msh_quad = 3,
    msh_hexahedron = 5,
    msh_prism = 6,
    msh_point = 15
};

}  // namespace lamina::io
