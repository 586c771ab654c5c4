// Estimates of the triangles that an angle bound alone asks for.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <lamina/delaunay.hpp>

#include "support/planar_graphs.hpp"

namespace lamina::test {
namespace {

/// Triangles by estimate, and those made.
struct Estimated {
    RefinementEstimate estimate;
    double made = 0;
};

/// Refines what lies inside a graph, without sizes.
Estimated refine_for_angles(const PlanarGraph& graph, double min_angle_deg) {
    const SizeField size(1e30);
    const ConstrainedRefineOptions options{.refine = {.min_angle_deg = min_angle_deg}};
    const ConstrainedTriangulation coarse =
        triangulate(graph.points, graph.segments, {.keep = KeptRegion::inside_segments});
    return {estimate_triangles(graph.points, coarse, size, options),
            static_cast<double>(refine(graph.points, coarse, size, options).triangles.size())};
}

PlanarGraph loop(const std::vector<Point>& corners) {
    PlanarGraph graph;
    graph.add_loop(corners);
    return graph;
}

void expect_near_estimate(const PlanarGraph& graph, double min_angle_deg, const std::string& what) {
    const auto [estimate, made] = refine_for_angles(graph, min_angle_deg);
    EXPECT_LT(made, 3 * estimate.triangles()) << what << ", " << min_angle_deg << " degrees";
    EXPECT_GT(made, estimate.triangles() / 3) << what << ", " << min_angle_deg << " degrees";
    EXPECT_LE(estimate.least_by_angles, made) << what << ", " << min_angle_deg << " degrees";
    EXPECT_GT(estimate.least_by_angles, made / 100) << what << ", " << min_angle_deg << " degrees";
}

TEST(EstimateForAngles, IsNearInChannels) {
    for (const double angle : {5.0, 20.7, 33.0}) {
        for (const double width : {1e-2, 0.7e-2, 0.5e-2}) {
            expect_near_estimate(loop({{0, 0}, {6.1, 0}, {6, width}, {0, width}}), angle, "strip");
            PlanarGraph slit = loop({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
            slit.add_loop({{2, 5}, {8, 5}, {8, 5 + width}, {2, 5 + width}});
            expect_near_estimate(slit, angle, "slit");
            PlanarGraph dangling = loop({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
            dangling.add_segment({2, 5}, {8, 5});
            dangling.add_segment({2.1, 5 + width}, {8, 5 + 2 * width});
            expect_near_estimate(dangling, angle, "two dangling segments");
        }
    }
}

TEST(EstimateForAngles, SharpCornersAskForLittle) {
    for (const double angle : {20.7, 33.0}) {
        for (const double length : {1.1, 1.3, 1.9, 2.5}) {
            const auto [estimate, made] = refine_for_angles(loop({{0, 0}, {1, 0}, {length, 3e-4 * length}}), angle);
            EXPECT_LT(made, 300) << length;
            EXPECT_LT(estimate.least_by_angles, 10) << length;
            EXPECT_LT(estimate.triangles(), 1000) << length;
        }
    }
}

TEST(EstimateForAngles, CornersWithEqualSidesAskForLittle) {
    const auto [estimate, made] = refine_for_angles(loop({{0, 0}, {1, 1e-4}, {1, -1e-4}}), 20.7);
    EXPECT_LT(made, 100);
    EXPECT_LT(estimate.triangles(), 100);
}

TEST(EstimateForAngles, LeastNumberIsNeverTooLarge) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const RandomGraph random = random_planar_graph(seed);
        const auto [estimate, made] = refine_for_angles(random.graph, 20.7 + 0.2 * static_cast<double>(seed));
        EXPECT_LE(estimate.least_by_angles, made) << random.kind << " " << seed;
    }
}

TEST(EstimateForAngles, IsFiniteWhereTheNumberIsHuge) {
    const PlanarGraph strip = loop({{0, 0}, {4e9, 0}, {4e9, 5e5}, {0, 5e5}});
    const ConstrainedTriangulation coarse = triangulate(strip.points, strip.segments);
    const auto estimate = [&](double min_angle_deg, bool split) {
        return estimate_triangles(strip.points, coarse, SizeField(1e30),
                                  {.refine = {.min_angle_deg = min_angle_deg}, .split_segments = split});
    };
    EXPECT_NEAR(estimate(20.7, true).by_angles, 2 * std::tan(20.7 * M_PI / 180) * 4e9 / 5e5, 1e3);
    EXPECT_EQ(estimate(20.7, false).by_angles, 4);
    EXPECT_EQ(estimate(0, true).triangles(), 2);
}

TEST(EstimateForAngles, NarrowChannelsAskForManyUntilTheirSidesNearlyCoincide) {
    // It splits nothing where sides run beside each other for ten thousand times their distance.
    for (const double width : {2e-4, 5e-5, 1e-7, 1e-12, 2e-13, 5e-14, 1e-15, 1e-20, 1e-60}) {
        for (const double slope : {0.0, 0.3, 1.0}) {
            const double w = slope > 0 ? std::max(width, 1e-15) : width;
            const PlanarGraph strip = loop({{0, 0}, {1, slope}, {1, slope + w}, {0, w}});
            const ConstrainedTriangulation coarse = triangulate(strip.points, strip.segments);
            const ConstrainedRefineOptions options{.refine = {.min_angle_deg = 20}};
            const RefinementEstimate estimate = estimate_triangles(strip.points, coarse, SizeField(10), options);
            EXPECT_TRUE(std::isfinite(estimate.by_angles));
            if (width > 1e-4) {
                EXPECT_GT(estimate.least_by_angles, 0.3 / width) << width << " " << slope;
                continue;
            }
            EXPECT_LT(estimate.triangles(), 5000) << width << " " << slope;
            const ConstrainedRefinement fine = refine(strip.points, coarse, SizeField(10), options);
            EXPECT_LT(fine.triangles.size(), 1000u) << width << " " << slope;
            EXPECT_EQ(fine.stats.exempt, fine.stats.below_bound);
        }
    }
    // In a corner of 1e-28 radians it ends at once.
    const PlanarGraph corner = loop({{0, 0}, {1, 0.3}, {2, std::nextafter(0.6, 1)}});
    const ConstrainedTriangulation coarse = triangulate(corner.points, corner.segments);
    EXPECT_LT(estimate_triangles(corner.points, coarse, SizeField(10), {.refine = {.min_angle_deg = 20}}).triangles(),
              1000);
}

}  // namespace
}  // namespace lamina::test
