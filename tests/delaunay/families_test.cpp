// Validates, exactly, every family of inputs of the benchmarks, at the size of 1e5 triangles or points.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>

#include "support/triangulation_checks.hpp"
#include "support/triangulation_families.hpp"

namespace lamina::test {
namespace {

TEST(TriangulationFamilies, PlainTriangulations) {
    constexpr std::size_t n = 100'000;
    for (const std::vector<Point>& points :
         {random_points(n, 3), naca_layer_points(n), square_lattice(316, 316), hexagonal_lattice(316, 316),
          flat_plate_points(n, 1, 0), flat_plate_points(n, 0.984807753012208, 0.17364817766693033)})
        expect_valid(points, triangulate(points).triangles);
}

TEST(TriangulationFamilies, Constraints) {
    for (const std::size_t one_edge_in : {30, 3}) {
        const ConstrainedCase c = stretched_edges_case(100'000, one_edge_in);
        expect_valid(c.points, triangulate(c.points, c.segments).triangles, c.segments);
    }
}

/// The smallest and the mean smallest angle of triangles, in degrees.
struct AngleQuality {
    double smallest = 180, mean = 0;
};

AngleQuality quality_of(const std::vector<Point>& points, const std::vector<Triangle>& triangles) {
    AngleQuality q;
    for (const Triangle& t : triangles) {
        const double angle = smallest_angle_deg(points, t);
        q.smallest = std::min(q.smallest, angle);
        q.mean += angle / static_cast<double>(triangles.size());
    }
    return q;
}

TEST(TriangulationFamilies, Refinements) {
    for (const double area_ratio : {1.0, 1000.0})
        for (const double min_angle_deg : {20.7, 30.0})
            for (const bool patches : {false, true}) {
                SCOPED_TRACE(testing::Message() << "area ratio " << area_ratio << ", " << min_angle_deg << " degrees, "
                                                << (patches ? "patches" : "pure"));
                const RefinementCase c = unit_square_case(1e5, area_ratio);
                RefineOptions options;
                options.min_angle_deg = min_angle_deg;
                options.lattice = patches;
                const Refinement r = refine(c.border.points, c.border.segments, c.field, options);
                std::vector<Point> points = c.border.points;
                points.insert(points.end(), r.steiner_points.begin(), r.steiner_points.end());
                expect_valid(points, r.triangles, c.border.segments);
                EXPECT_EQ(r.stats.below_bound, 0u);
                EXPECT_EQ(r.stats.oversized, 0u);
                const AngleQuality q = quality_of(points, r.triangles);
                EXPECT_GE(q.smallest, min_angle_deg - 1e-6);
                EXPECT_GE(q.mean, 46.5);
                EXPECT_NEAR(static_cast<double>(r.triangles.size()), 1e5, 4e4);
            }
}

}  // namespace
}  // namespace lamina::test
