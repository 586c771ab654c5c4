#include "support/point_sets.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <lamina/predicates.hpp>

namespace lamina::test {

std::vector<Point> random_points(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    std::vector<Point> points(n);
    for (Point& p : points) {
        p.x = random.real();
        p.y = random.real();
    }
    return points;
}

std::vector<Point> square_lattice(int nx, int ny) {
    std::vector<Point> points;
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j) points.push_back({double(i), double(j)});
    return points;
}

std::vector<Point> hexagonal_lattice(int nx, int ny) {
    std::vector<Point> points;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) points.push_back({i + 0.5 * (j % 2), j * 0.8660254037844386});
    return points;
}

std::vector<Point> cocircular_points(int k) {
    std::vector<Point> points;
    const int r = 65 * k;
    for (int x = -r; x <= r; ++x)
        for (int y = -r; y <= r; ++y)
            if (x * x + y * y == r * r) points.push_back({double(x), double(y)});
    return points;
}

std::vector<Point> random_grid_points(std::size_t n, int side, std::uint64_t seed) {
    Random random(seed);
    std::set<std::pair<int, int>> seen;
    std::vector<Point> points;
    while (points.size() < n) {
        const int x = int(random.below(side)), y = int(random.below(side));
        if (seen.insert({x, y}).second) points.push_back({double(x), double(y)});
    }
    return points;
}

std::vector<Point> layer_points(std::size_t around, std::size_t layers, double growth) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < around; ++i) {
        const double t = 2 * M_PI * double(i) / double(around);
        const Point wall{std::cos(t), 0.12 * std::sin(t)};
        const Point normal = unit({0.12 * std::cos(t), std::sin(t)});
        double height = 0, step = 1e-5;
        for (std::size_t j = 0; j <= layers; ++j) {
            points.push_back(wall + height * normal);
            height += step;
            step *= growth;
        }
    }
    return points;
}

void Border::add_loop(const std::vector<Point>& corners, double spacing) {
    const std::size_t first = points.size();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point a = corners[i], b = corners[(i + 1) % corners.size()];
        const int n = std::max(1, int(std::ceil(distance(a, b) / spacing - 1e-9)));
        for (int j = 0; j < n; ++j) points.push_back(a + (double(j) / n) * (b - a));
    }
    close_loop(first);
}

void Border::close_loop(std::size_t first_point) {
    for (std::size_t i = first_point; i < points.size(); ++i)
        segments.push_back({VertexId{i}, VertexId{i + 1 < points.size() ? i + 1 : first_point}});
}

Border square_border(double side, double spacing) {
    Border border;
    border.add_loop({{0, 0}, {side, 0}, {side, side}, {0, side}}, spacing);
    return border;
}

std::vector<Triangle> canonical(std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) std::rotate(t.v, std::min_element(t.v, t.v + 3), t.v + 3);
    std::sort(triangles.begin(), triangles.end(), [](const Triangle& a, const Triangle& b) {
        return std::lexicographical_compare(a.v, a.v + 3, b.v, b.v + 3);
    });
    return triangles;
}

std::vector<Triangle> brute_force_delaunay(const std::vector<Point>& points) {
    std::vector<Triangle> result;
    const std::size_t n = points.size();
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = a + 1; b < n; ++b)
            for (std::size_t c = a + 1; c < n; ++c) {
                if (c == b || orient2d(points[a], points[b], points[c]) <= 0) continue;
                bool empty = true;
                for (std::size_t d = 0; d < n && empty; ++d)
                    if (d != a && d != b && d != c)
                        empty = incircle_perturbed(points[a], points[b], points[c], points[d]) < 0;
                if (empty) result.push_back({VertexId{a}, VertexId{b}, VertexId{c}});
            }
    return canonical(result);
}

double covered_area(const std::vector<Point>& points, const std::vector<Triangle>& triangles) {
    double area = 0;
    for (const Triangle& t : triangles)
        area += 0.5 *
                cross(points[t.v[1].index()] - points[t.v[0].index()], points[t.v[2].index()] - points[t.v[0].index()]);
    return area;
}

double smallest_angle_deg(const std::vector<Point>& points, const Triangle& t) {
    double smallest = 180;
    for (int i = 0; i < 3; ++i) {
        const Point p = points[t.v[i].index()], a = points[t.v[(i + 1) % 3].index()] - p,
                    b = points[t.v[(i + 2) % 3].index()] - p;
        smallest = std::min(smallest, std::atan2(cross(a, b), dot(a, b)) * 180 / M_PI);
    }
    return smallest;
}

}  // namespace lamina::test
