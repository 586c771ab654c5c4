// The numbers of VTK for the types of cells. SU2 uses them, too. Source: VTK User's Guide, "VTK File Formats".
#pragma once

#include <cstdint>

namespace lamina::io {

enum VtkCellType : std::uint8_t {
    vtk_vertex = 1,
    vtk_poly_vertex = 2,
    vtk_line = 3,
    vtk_poly_line = 4,
    vtk_triangle = 5,
    vtk_quad = 9,
    vtk_hexahedron = 12,
    vtk_wedge = 13,
    vtk_quadratic_edge = 21,
    vtk_quadratic_triangle = 22,
    vtk_biquadratic_quad = 28,
    vtk_lagrange_curve = 68,
    vtk_lagrange_triangle = 69,
    vtk_lagrange_quad = 70
};

}  // namespace lamina::io
