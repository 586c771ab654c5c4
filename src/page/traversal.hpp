// The order in which a page stores cells and vertices: each cell is found across an edge of one that is stored already,
// so that connectivity takes little more than one symbol a cell, and vertices can be predicted from their neighbours.
//
// Cells grow in rings. The front is the cyclic list of *gates*, the edges between what is stored and what is not. A
// gate s -> t has the stored cell on its left. The gates wait in a queue, in the order in which they came to be. The
// cell across the first one has a third vertex c:
//
//            c                      the gate s -> t is replaced by s -> c and c -> t. Where c is where the gate
//           / \                     before it begins or the gate behind it ends, and the cell lies across that
//    ... - s---t - ...              gate, too, both gates disappear.
//         stored
//
// A quadrilateral is two such triangles, the second across the diagonal from c to t. Where no cell is left across any
// gate, the first cell that is not stored yet begins anew. share/page/decode.js reads it. Source, in the main: C.
// Touma, C. Gotsman, Triangle mesh compression (1998); J. Rossignac, Edgebreaker (1999).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::page {

/// The kinds of the third vertex of a triangle across a gate. A quadrilateral's first symbol has quad_mark added.
enum Symbol : std::uint8_t {
    no_cell,  ///< nothing is stored here: the gate is on the boundary, or its cell has come in from elsewhere
    fresh,    ///< the next vertex that was not met before
    before,   ///< where the gate before begins
    behind,   ///< where the gate behind ends
    closing,  ///< both
    distant,  ///< another vertex that was met before: its number is stored
};
inline constexpr std::uint8_t quad_mark = 6;

/// The three vertices, in the new numbering, from which the place of a vertex is predicted: a + b - o.
using Prediction = std::array<std::uint32_t, 3>;
inline constexpr std::uint32_t no_vertex = 0xffffffff;

/// The cells and vertices of a mesh in their new order.
struct Traversal {
    std::vector<std::uint8_t> symbols;  ///< for each gate that is looked at; no_cell or quad_mark where one begins
    std::vector<std::uint32_t>
        references;                      ///< per `distant`: fresh vertices so far - number. Per corner of a cell that
                                         ///< begins anew: 0 for a fresh vertex, else the same
    std::vector<std::uint32_t> cell;     ///< per new number: number of the cell in the mesh
    std::vector<std::uint32_t> parent;   ///< per new number: the cell across whose edge it was found, or no_vertex
    std::vector<std::uint32_t> vertex;   ///< per new number: number of the vertex in the mesh
    std::vector<Prediction> prediction;  ///< per new number; no_vertex for the first vertex of all
    std::vector<std::uint32_t> new_number;  ///< per vertex of the mesh, or no_vertex for those of no cell
};

/// Orders the cells and vertices of a mesh. Precondition: all indices are in range.
Traversal traverse(const Mesh& mesh);

}  // namespace lamina::page
