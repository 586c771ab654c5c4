#include "io/nektar_nodes.hpp"

#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

#include "mesh/determinant_rule.hpp"

namespace lamina::io {

namespace {

constexpr std::size_t nodes_of_border = 12, nodes_within = 3;

/// Returns Lagrange's polynomials of the nodes of gauss_lobatto at the three places of Nektar++.
std::array<std::vector<double>, nodes_within> weights_at(double place) {
    const auto at = [](double s, double t) {
        return mesh::lagrange_in_triangle(4, NodeDistribution::gauss_lobatto, s, t);
    };
    return {at(place, place), at(1 - 2 * place, place), at(place, 1 - 2 * place)};
}

Point weighed(std::span<const double> weights, std::span<const Point> points) {
    Point sum{0, 0};
    for (std::size_t i = 0; i < points.size(); ++i) sum = sum + weights[i] * points[i];
    return sum;
}

}  // namespace

void move_to_nektar_places(std::span<Point> nodes, double place) {
    assert(nodes.size() == nodes_of_border + nodes_within);
    const auto weights = weights_at(place);
    std::array<Point, nodes_within> moved;
    for (std::size_t m = 0; m < nodes_within; ++m) moved[m] = weighed(weights[m], nodes);
    for (std::size_t m = 0; m < nodes_within; ++m) nodes[nodes_of_border + m] = moved[m];
}

void move_from_nektar_places(std::span<Point> nodes, double place) {
    assert(nodes.size() == nodes_of_border + nodes_within);
    const auto weights = weights_at(place);
    // By symmetry the weights of the three nodes at the three places are a matrix c I + d J, where all of J is 1.
    const double d = weights[0][nodes_of_border + 1], c = weights[0][nodes_of_border] - d;
    std::array<Point, nodes_within> rest;
    Point sum{0, 0};
    for (std::size_t m = 0; m < nodes_within; ++m) {
        rest[m] = nodes[nodes_of_border + m] - weighed(weights[m], nodes.first(nodes_of_border));
        sum = sum + rest[m];
    }
    for (std::size_t m = 0; m < nodes_within; ++m)
        nodes[nodes_of_border + m] = (1 / c) * (rest[m] - (d / (c + nodes_within * d)) * sum);
}

}  // namespace lamina::io
