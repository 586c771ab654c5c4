// Point sets that tests share: random ones, and those full of ties.
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/point.hpp>

#include "core/random.hpp"

namespace lamina::test {

using core::Random;

std::vector<Point> random_points(std::size_t n, std::uint64_t seed);
/// nx by ny unit squares' corners.
std::vector<Point> square_lattice(int nx, int ny);
/// Rows of a triangular lattice with integer-exact ties in the rows only.
std::vector<Point> hexagonal_lattice(int nx, int ny);
/// Points with integer coordinates on the circle x^2 + y^2 = 65^2 k^2: exactly cocircular.
std::vector<Point> cocircular_points(int k = 1);
/// Distinct points of a small integer grid: every kind of degeneracy at once.
std::vector<Point> random_grid_points(std::size_t n, int side, std::uint64_t seed);
/// Layer points over an ellipse: near-cocircular, thin.
std::vector<Point> layer_points(std::size_t around, std::size_t layers, double growth = 1.2);

/// The n-gon-like closed border through `corners`, each side cut in equal parts no longer than `spacing`.
struct Border {
    std::vector<Point> points;
    std::vector<Segment> segments;
    void add_loop(const std::vector<Point>& corners, double spacing);
};
Border square_border(double side, double spacing);

/// Triangles rotated to their smallest vertex and sorted: the set, whatever the order they came in.
std::vector<Triangle> canonical(std::vector<Triangle> triangles);

/// Every Delaunay triangle by brute force over all triples, O(n^4), by the tie rule.
std::vector<Triangle> brute_force_delaunay(const std::vector<Point>& points);

double smallest_angle_deg(const std::vector<Point>& points, const Triangle& t);

}  // namespace lamina::test
