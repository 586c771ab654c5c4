// The plane elements of CGNS, of orders 1 to 4, and the order of their nodes. Source: CGNS Standard Interface Data
// Structures, "Unstructured grid element numbering conventions".
#pragma once

#include <cgnslib.h>

#include <array>
#include <cstddef>

#include <lamina/curved_mesh.hpp>

#include "mesh/cell_lattice.hpp"

namespace lamina::io {

/// An element with 2, 3 or 4 corners.
struct CgnsElement {
    ElementType_t type;
    unsigned corners, order;

    std::size_t nodes() const { return mesh::nodes_of_cell(corners, order); }
};

inline constexpr std::array<CgnsElement, 12> cgns_plane_elements{{{BAR_2, 2, 1},
                                                                  {TRI_3, 3, 1},
                                                                  {QUAD_4, 4, 1},
                                                                  {BAR_3, 2, 2},
                                                                  {TRI_6, 3, 2},
                                                                  {QUAD_9, 4, 2},
                                                                  {BAR_4, 2, 3},
                                                                  {TRI_10, 3, 3},
                                                                  {QUAD_16, 4, 3},
                                                                  {BAR_5, 2, 4},
                                                                  {TRI_15, 3, 4},
                                                                  {QUAD_25, 4, 4}}};

/// Returns the element of this type; null for other types.
constexpr const CgnsElement* find_cgns_element(ElementType_t type) {
    for (const CgnsElement& element : cgns_plane_elements)
        if (element.type == type) return &element;
    return nullptr;
}

/// Returns the element with so many corners. Precondition: there is one.
constexpr const CgnsElement& cgns_element(unsigned corners, unsigned order) {
    for (const CgnsElement& element : cgns_plane_elements)
        if (element.corners == corners && element.order == order) return element;
    return cgns_plane_elements[0];
}

/// Returns the place in the order of CurvedNodes of node k of an element. They differ within quadrilaterals of order 4,
/// whose inner nodes run round their border in CGNS:
///
///        22--21--20        19--22--18
///        |        |        |        |
///        23  24  19   is   23  24  21   in the order of CurvedNodes.
///        |        |        |        |
///        16--17--18        16--20--17
constexpr std::size_t place_of_cgns_node(const CgnsElement& element, std::size_t k) {
    constexpr std::size_t first = 16;
    constexpr std::array<std::size_t, 9> inner{16, 20, 17, 21, 18, 22, 19, 23, 24};
    return element.type == QUAD_25 && k >= first ? inner[k - first] : k;
}

}  // namespace lamina::io
