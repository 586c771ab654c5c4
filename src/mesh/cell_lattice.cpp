#include "mesh/cell_lattice.hpp"

#include <array>
#include <cassert>
#include <vector>

namespace lamina::mesh {

namespace {

using Lattice = std::vector<LatticePlace>;

/// Adds the nodes of a cell of this order whose first corner is at (first, first): its border, then the cell within.
void add_rings(unsigned corners, unsigned first, unsigned order, Lattice& lattice) {
    if (order == 0) return lattice.push_back({first, first});
    const std::array<LatticePlace, 4> triangle{{{0, 0}, {1, 0}, {0, 1}, {0, 0}}},
        quad{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const auto corner = [&](unsigned k) { return (corners == 3 ? triangle : quad)[k % corners]; };
    const auto add = [&](unsigned edge, unsigned step) {
        const LatticePlace a = corner(edge), b = corner(edge + 1);
        lattice.push_back({first + (order - step) * a.i + step * b.i, first + (order - step) * a.j + step * b.j});
    };
    for (unsigned k = 0; k < corners; ++k) add(k, 0);
    for (unsigned k = 0; k < corners; ++k)
        for (unsigned step = 1; step < order; ++step) add(k, step);
    // The nodes within a cell of order p are those of one of order p - 2, or p - 3 for triangles.
    const unsigned less = corners == 3 ? 3 : 2;
    if (order >= less) add_rings(corners, first + 1, order - less, lattice);
}

using LatticesByOrder = std::array<Lattice, max_cell_order + 1>;

LatticesByOrder make_lattices(unsigned corners) {
    LatticesByOrder lattices;
    for (unsigned order = 1; order <= max_cell_order; ++order) add_rings(corners, 0, order, lattices[order]);
    return lattices;
}

}  // namespace

std::span<const LatticePlace> lattice_of_cell(unsigned corners, unsigned order) {
    assert((corners == 3 || corners == 4) && order >= 1 && order <= max_cell_order);
    static const LatticesByOrder triangles = make_lattices(3), quads = make_lattices(4);
    return (corners == 3 ? triangles : quads)[order];
}

}  // namespace lamina::mesh
