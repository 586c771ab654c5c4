// Point sets that tests share: random ones, and those full of ties.
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/point.hpp>

namespace lamina::test {

/// Deterministic random numbers, the same on every platform (splitmix64).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double real() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double real(double low, double high) { return low + (high - low) * real(); }
    std::size_t below(std::size_t n) { return bits() % n; }

private:
    std::uint64_t state_;
};

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
