// The numbers of Gmsh for the types of elements. Source: Gmsh reference manual, "Gmsh mesh file formats".
#pragma once

#include <array>
#include <cstddef>

namespace lamina::io {

enum MshElementType : int {
    msh_line = 1,
    msh_triangle = 2,
    msh_quad = 3,
    msh_hexahedron = 5,
    msh_prism = 6,
    msh_point = 15
};

/// A plane element of some order: its number of corners, 2 for lines, and of nodes, corners included.
struct MshElement {
    int type;
    std::size_t corners;
    unsigned order;
    std::size_t nodes;
};

inline constexpr std::array<MshElement, 12> msh_plane_elements{{{msh_line, 2, 1, 2},
                                                                {msh_triangle, 3, 1, 3},
                                                                {msh_quad, 4, 1, 4},
                                                                {8, 2, 2, 3},
                                                                {9, 3, 2, 6},
                                                                {10, 4, 2, 9},
                                                                {26, 2, 3, 4},
                                                                {21, 3, 3, 10},
                                                                {36, 4, 3, 16},
                                                                {27, 2, 4, 5},
                                                                {23, 3, 4, 15},
                                                                {37, 4, 4, 25}}};

/// Returns the element of this type; null for other types.
constexpr const MshElement* find_msh_element(int type) {
    for (const MshElement& element : msh_plane_elements)
        if (element.type == type) return &element;
    return nullptr;
}

/// Returns the element with so many corners. Precondition: there is one.
constexpr const MshElement& msh_element(std::size_t corners, unsigned order) {
    for (const MshElement& element : msh_plane_elements)
        if (element.corners == corners && element.order == order) return element;
    return msh_plane_elements[0];
}

}  // namespace lamina::io
