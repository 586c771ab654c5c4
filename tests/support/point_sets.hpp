// Points, borders and simple measures that tests and benchmarks of triangulations share. Many of the points are full of
// ties.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/point.hpp>

#include "core/random.hpp"

namespace lamina::test {

using core::Random;

/// Returns n points in the unit square.
std::vector<Point> random_points(std::size_t n, std::uint64_t seed);
/// Returns nx by ny points with integer coordinates.
std::vector<Point> square_lattice(int nx, int ny);
/// Returns nx by ny points of a lattice of equilateral triangles with unit edges. Heights of rows are rounded, so only
/// ties within rows are exact.
std::vector<Point> hexagonal_lattice(int nx, int ny);
/// Returns the points with integer coordinates on the circle x^2 + y^2 = 65^2 k^2, which are exactly cocircular.
std::vector<Point> cocircular_points(int k = 1);
/// Returns n distinct points with integer coordinates from 0 to side - 1, which make every kind of degeneracy at once.
std::vector<Point> random_grid_points(std::size_t n, int side, std::uint64_t seed);
/// Returns the points of a layer round an ellipse, on `around` rays: nearly cocircular, in thin cells.
std::vector<Point> layer_points(std::size_t around, std::size_t layers, double growth = 1.2);

/// Swaps the items into a random order.
template <class T>
void shuffle(std::vector<T>& items, Random& random) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

/// The border of a region.
struct Border {
    std::vector<Point> points;
    std::vector<Segment> segments;

    /// Appends a closed polygon, each side divided into equal segments no longer than `spacing`.
    void add_loop(const std::vector<Point>& corners, double spacing);
    /// Appends one segment from each point to the next one, and one from the last to the first.
    void close_loop(std::size_t first_point = 0);
};
/// Returns the border of a square with one corner at the origin.
Border square_border(double side, double spacing);

/// Returns the triangles rotated to their smallest vertex and sorted, so that equal sets of triangles become equal.
std::vector<Triangle> canonical(std::vector<Triangle> triangles);

/// Returns all Delaunay triangles of the points by the tie rule, in canonical() form. Tests all triples, O(n^4).
std::vector<Triangle> brute_force_delaunay(const std::vector<Point>& points);

/// Returns the sum of the areas of the triangles.
double covered_area(const std::vector<Point>& points, const std::vector<Triangle>& triangles);

/// Returns the smallest angle of one triangle.
double smallest_angle_deg(const std::vector<Point>& points, const Triangle& t);

}  // namespace lamina::test
