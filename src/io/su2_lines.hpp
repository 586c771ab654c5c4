// The lines of the SU2 format: what the writer of whole meshes and the one of parts have in common.
#pragma once

#include <ostream>
#include <span>

#include <lamina/mesh.hpp>

#include "io/text_output.hpp"
#include "io/vtk_cell_types.hpp"

namespace lamina::io {

/// Puts the line of cell i: its type, its vertices, its number.
template <class Cell>
void put_su2_cell(LineText& line, const Cell& cell, std::size_t i) {
    line << std::size_t{std::size(cell.v) == 3 ? vtk_triangle : vtk_quad};
    for (const VertexId v : cell.v) line << v.index();
    line << i;
}

/// Puts the line of vertex i.
inline void put_su2_point(LineText& line, Point p, std::size_t i) { line << p << i; }

/// Writes the section NMARK.
void write_su2_markers(std::span<const Marker> markers, std::ostream& out);

}  // namespace lamina::io
