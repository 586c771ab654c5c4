// Voronoi diagrams against cells that are clipped by the bisectors to all other points.
#include <lamina/voronoi.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

double area_of(std::span<const Point> polygon) {
    double twice = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k)
        twice += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    return 0.5 * twice;
}

/// Returns the cell of point v, cut from the polygon by the bisectors to all points.
std::vector<Point> brute_force_cell(const std::vector<Point>& points, std::size_t v, std::vector<Point> cell) {
    for (std::size_t w = 0; w < points.size() && !cell.empty(); ++w) {
        if (w == v) continue;
        std::vector<Point> kept;
        const Point middle = midpoint(points[v], points[w]), normal = points[w] - points[v];
        for (std::size_t k = 0; k < cell.size(); ++k) {
            const Point p = cell[k], q = cell[(k + 1) % cell.size()];
            const double at_p = dot(p - middle, normal), at_q = dot(q - middle, normal);
            if (at_p <= 0) kept.push_back(p);
            if (at_p * at_q < 0) kept.push_back(p + (at_p / (at_p - at_q)) * (q - p));
        }
        cell = kept;
    }
    return cell;
}

const std::vector<Point> hexagon{{-0.1, 0.3}, {0.4, -0.2}, {1.2, 0.1}, {1.1, 0.8}, {0.6, 1.3}, {0, 0.9}};

std::vector<std::vector<Point>> point_sets() {
    std::vector<std::vector<Point>> sets{
        random_points(150, 1), layer_points(20, 8), {{0.3, 0.4}}, {}, {{0.2, 0.2}, {0.8, 0.8}, {0.5, 0.5}, {3, 3}}};
    for (auto points : {square_lattice(8, 8), random_grid_points(60, 9, 3), cocircular_points()}) {
        for (Point& p : points) p = {p.x / 8, p.y / 8};
        sets.push_back(points);
    }
    return sets;
}

TEST(Voronoi, ClippedCellsAreThoseOfAllBisectors) {
    for (const auto& points : point_sets()) {
        const VoronoiCells cells = clipped_voronoi_cells(points, triangulate(points).triangles, hexagon);
        ASSERT_EQ(cells.size(), points.size());
        double sum = 0;
        for (std::size_t v = 0; v < points.size(); ++v) {
            const std::vector<Point> expected = brute_force_cell(points, v, hexagon);
            ASSERT_NEAR(area_of(cells[v]), area_of(expected), 1e-12);
            sum += area_of(cells[v]);
            // Every corner of either cell lies in the other: nothing else of this area does.
            for (const Point corner : cells[v])
                for (const Point q : points) ASSERT_LE(distance(corner, points[v]), distance(corner, q) + 1e-12);
        }
        if (!points.empty()) {
            EXPECT_NEAR(sum, area_of(hexagon), 1e-12);
        }
    }
}

TEST(Voronoi, CornersAreAsFarFromThePointsOfTheirCellsAndFartherFromNone) {
    for (const auto& points : {random_points(200, 2), square_lattice(7, 7), random_grid_points(80, 10, 4)}) {
        const std::vector<Triangle> triangles = triangulate(points).triangles;
        const VoronoiDiagram diagram = voronoi_diagram(points, triangles);
        ASSERT_EQ(diagram.corners.size(), triangles.size());
        ASSERT_EQ(diagram.cells.items.size(), 3 * triangles.size());
        for (std::size_t v = 0; v < points.size(); ++v)
            for (const std::uint32_t t : diagram.cells[v]) {
                const Point c = diagram.corners[t];
                const double radius = distance(c, points[v]);
                for (const Point q : points) ASSERT_GE(distance(c, q), radius * (1 - 1e-9) - 1e-12);
            }
    }
}

TEST(Voronoi, BoundedCellsAreTheClippedOnes) {
    const std::vector<Point> points = random_points(300, 6);
    const std::vector<Triangle> triangles = triangulate(points).triangles;
    const VoronoiDiagram diagram = voronoi_diagram(points, triangles);
    std::vector<char> open(points.size(), 0);
    for (const VoronoiRay& ray : diagram.rays) open[ray.a.index()] = 1;
    const double far = 1e6;
    const std::vector<Point> box{{-far, -far}, {far, -far}, {far, far}, {-far, far}};
    for (std::size_t v = 0; v < points.size(); ++v) {
        if (open[v]) continue;
        std::vector<Point> cell;
        for (const std::uint32_t t : diagram.cells[v]) cell.push_back(diagram.corners[t]);
        const double area = area_of(brute_force_cell(points, v, box));
        EXPECT_NEAR(area_of(cell), area, 1e-5 * (1 + area));
    }
}

TEST(Voronoi, RaysLeaveTheHullBetweenItsPoints) {
    const std::vector<Point> points = random_grid_points(80, 10, 5);
    const VoronoiDiagram diagram = voronoi_diagram(points, triangulate(points).triangles);
    ASSERT_FALSE(diagram.rays.empty());
    for (const VoronoiRay& ray : diagram.rays) {
        const Point a = points[ray.a.index()], b = points[ray.b.index()];
        EXPECT_EQ(dot(ray.direction, b - a), 0);
        const Point p = diagram.corners[ray.triangle.index()] + 1000 * ray.direction;
        EXPECT_NEAR(distance(p, a), distance(p, b), 1e-9);
        for (const Point q : points) EXPECT_GE(distance(p, q), distance(p, a) - 1e-9);
    }
}

TEST(Voronoi, DoesNotDependOnTheNumberOfThreads) {
    const std::vector<Point> points = random_points(20000, 7);
    const std::vector<Triangle> triangles = triangulate(points).triangles;
    std::vector<VoronoiCells> cells;
    for (const unsigned threads : {1u, 4u})
        with_threads(threads, [&] { cells.push_back(clipped_voronoi_cells(points, triangles, hexagon)); });
    EXPECT_EQ(cells[0].starts, cells[1].starts);
    EXPECT_EQ(cells[0].corners, cells[1].corners);
}

TEST(Voronoi, RefusesPolygonsThatAreNotConvex) {
    const std::vector<Point> points = random_points(10, 8);
    const std::vector<Triangle> triangles = triangulate(points).triangles;
    const std::vector<Point> clockwise(hexagon.rbegin(), hexagon.rend()), line{{0, 0}, {1, 0}, {2, 0}},
        star{{0, 0}, {1, 2}, {2, 0}, {0, 1.5}, {2, 1.5}}, straight{{0, 0}, {1, 0}, {2, 0}, {2, 2}};
    for (const auto& polygon : {clockwise, line, star, straight, std::vector<Point>{{0, 0}, {1, 1}}})
        EXPECT_THROW(clipped_voronoi_cells(points, triangles, polygon), InputError);
}

}  // namespace
}  // namespace lamina::test
