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

using Places = std::vector<NodePlace>;

Places make_places(unsigned corners, unsigned p, NodeDistribution distribution) {
    const auto on_edge = [&](unsigned i) { return place_on_edge(p, i, distribution); };
    Places places;
    for (const LatticePlace& node : lattice_of_cell(corners, p)) {
        NodePlace place{on_edge(node.i), on_edge(node.j)};
        if (corners == 3 && distribution != NodeDistribution::equidistant) {
            const double sum = place.s + place.t + on_edge(p - node.i - node.j);
            place = {place.s / sum, place.t / sum};
        }
        places.push_back(place);
    }
    return places;
}

using PlacesByOrder = std::array<Places, max_cell_order + 1>;

PlacesByOrder make_all_places(unsigned corners, NodeDistribution distribution) {
    PlacesByOrder places;
    for (unsigned order = 1; order <= max_cell_order; ++order)
        places[order] = make_places(corners, order, distribution);
    return places;
}

}  // namespace

std::span<const LatticePlace> lattice_of_cell(unsigned corners, unsigned order) {
    assert((corners == 3 || corners == 4) && order >= 1 && order <= max_cell_order);
    static const LatticesByOrder triangles = make_lattices(3), quads = make_lattices(4);
    return (corners == 3 ? triangles : quads)[order];
}

double place_on_edge(unsigned order, unsigned i, NodeDistribution distribution) {
    assert(i <= order && order >= 1 && order <= max_cell_order);
    const bool is_at_end = i == 0 || i == order, is_first = i == 1;
    if (distribution == NodeDistribution::equidistant || is_at_end || 2 * i == order)
        return static_cast<double>(i) / order;
    // The zeros of the derivative of Legendre's polynomial of this order, from [-1, 1] to [0, 1].
    const double first = order == 3 ? 0.276393202250021030359 : 0.172673164646011428100;
    return is_first ? first : 1 - first;
}

double half_step_on_edge(unsigned order, unsigned k, NodeDistribution distribution) {
    if (distribution == NodeDistribution::equidistant) return static_cast<double>(k) / (2 * order);
    return 0.5 * (place_on_edge(order, k / 2, distribution) + place_on_edge(order, (k + 1) / 2, distribution));
}

std::span<const NodePlace> places_of_nodes(unsigned corners, unsigned order, NodeDistribution distribution) {
    assert((corners == 3 || corners == 4) && order >= 1 && order <= max_cell_order);
    static const std::array<std::array<PlacesByOrder, 2>, 2> places{
        {{make_all_places(3, NodeDistribution::equidistant), make_all_places(4, NodeDistribution::equidistant)},
         {make_all_places(3, NodeDistribution::gauss_lobatto), make_all_places(4, NodeDistribution::gauss_lobatto)}}};
    return places[static_cast<std::size_t>(distribution)][corners - 3][order];
}

}  // namespace lamina::mesh
