// The short cuts by which spacings are found, against the long way.
#include "surface/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "core/segments.hpp"
#include "support/shapes.hpp"
#include "surface/clearance.hpp"
#include "surface/crossings.hpp"

namespace lamina {
namespace {

/// Returns the clearance of a point by a look at every edge.
double clearance_by_all_edges(const Geometry& geometry, std::size_t element, Point p, Point normal, double min_own,
                              double max_clearance) {
    double nearest = max_clearance;
    for (const Element& other : geometry.elements)
        for (std::size_t i = 0; i < other.points.size(); ++i) {
            const Point a = other.points[i], b = other.points[(i + 1) % other.points.size()];
            const Point towards = midpoint(a, b) - p, edge_normal = unit(-perpendicular(b - a));
            const double d = core::distance_to_segment(p, a, b);
            if (&other != &geometry.elements[element]) {
                nearest = std::min(nearest, d);
            } else if (dot(towards, normal) > 0 && dot(towards, edge_normal) < 0 && dot(normal, edge_normal) < -0.5) {
                nearest = std::min(nearest, std::max(d, min_own));
            }
        }
    return nearest;
}

// The second edge folds back on the first one, and meets no other; the third one begins on the first one.
TEST(CrossingEdges, MayFoldBackOnTheNextOne) {
    Geometry folded = shapes::geometry({{{0, 0}, {4, 0}, {1, 0}, {1, 2}}});
    for (std::size_t turned = 0; turned < 4; ++turned) {  // also across the end of the list
        std::vector<Point>& p = folded.elements[0].points;
        std::vector<std::size_t> found;
        for (const surface::CrossingEdge& edge : surface::find_crossing_edges(folded)) found.push_back(edge.index);
        std::vector<std::size_t> expected{(4 - turned) % 4, (5 - turned) % 4, (6 - turned) % 4};
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(found, expected);
        std::rotate(p.begin(), p.begin() + 1, p.end());
    }
}

TEST(Clearance, IsThatOfTheNearestWallThatFaces) {
    std::mt19937 engine(1);
    core::Random random(2);
    const shapes::Outline bodies[] = {shapes::refined(shapes::comb(5, 0.1), 9),
                                      shapes::refined(shapes::c_shape(0.2), 20), shapes::star(300, 0.3, engine),
                                      shapes::section(0.12, 0, 60)};
    for (const shapes::Outline& body : bodies) {
        const Geometry geometry = shapes::geometry({body, shapes::moved(body, 0.4, 0.3, {2.3, 0.1})});
        const surface::ClearanceSearch search(geometry);
        for (const std::size_t element : {0, 1}) {
            const std::vector<Point>& points = geometry.elements[element].points;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Point next = points[(i + 1) % points.size()];
                const Point p = points[i] + random.real() * (next - points[i]);
                const Point normal = unit(-perpendicular(next - points[i]));
                for (const double min_own : {0.0, 0.05})
                    for (const double max_clearance : {0.02, 0.2, 5.0})
                        EXPECT_EQ(search.clearance(element, p, normal, min_own, max_clearance),
                                  clearance_by_all_edges(geometry, element, p, normal, min_own, max_clearance));
            }
        }
    }
}

/// Returns the sides of a polygon as curves, each sixth of which is kept.
std::vector<surface::OutlineCurve> sides_of(const shapes::Outline& polygon) {
    std::vector<surface::OutlineCurve> curves;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const surface::SmoothRun side{{polygon[i], polygon[(i + 1) % polygon.size()]}, false};
        curves.push_back({surface::SplineCurve(side), HUGE_VAL, i % 6 == 5});
    }
    return curves;
}

surface::SpacingRule rule_of(double max_spacing) {
    surface::SpacingRule rule{};
    rule.max_spacing = max_spacing;
    rule.min_spacing = 1e-4;
    rule.max_turning = 0.1;
    rule.tolerance = 1e-4;
    rule.gradation = 0.1;
    rule.max_corner_ratio = 1.2;
    return rule;
}

std::vector<double> spacings_of(const std::vector<surface::CurveSamples>& curves) {
    std::vector<double> spacings;
    for (const surface::CurveSamples& curve : curves)
        for (const surface::CurveSample& sample : curve) spacings.push_back(sample.spacing);
    return spacings;
}

TEST(Gradation, SpreadsFromALoweredCornerAsFromAll) {
    core::Random random(3);
    const std::vector<surface::OutlineCurve> curves = sides_of(shapes::circle(1, 24));
    surface::SampledCurves known;
    std::vector<surface::CurveSamples> samples = surface::sample_spacings(curves, rule_of(0.3), known).samples;
    surface::limit_gradation(curves, samples, 0.1);
    for (int round = 0; round < 200; ++round) {
        const auto corner = random.below(24);
        const std::size_t before = (corner + 23) % 24;
        if (!curves[corner].is_kept) samples[corner].front().spacing *= random.real(0.5, 1);
        if (!curves[before].is_kept) samples[before].back().spacing *= random.real(0.5, 1);
        std::vector<surface::CurveSamples> expected = samples;
        surface::limit_gradation(curves, expected, 0.1);
        std::vector<bool> is_changed(curves.size());
        const std::vector<surface::CurveSamples> lowered = samples;
        surface::limit_gradation_from(corner, curves, samples, 0.1, is_changed);
        ASSERT_EQ(spacings_of(samples), spacings_of(expected)) << round;
        for (std::size_t i = 0; i < curves.size(); ++i)
            EXPECT_EQ(is_changed[i], spacings_of({lowered[i]}) != spacings_of({samples[i]})) << round << ' ' << i;
    }
}

TEST(Samples, OfKnownCurvesAreThoseOfUnknownOnes) {
    std::mt19937 engine(4);
    const std::vector<surface::OutlineCurve> curves = sides_of(shapes::star(30, 0.4, engine));
    const surface::SpacingRule rule = rule_of(0.05);
    surface::SampledCurves known;
    const surface::SampledOutline first = surface::sample_spacings(curves, rule, known);
    EXPECT_EQ(known.size(), 25u) << "kept curves are not sampled";
    EXPECT_EQ(spacings_of(surface::sample_spacings(curves, rule, known).samples), spacings_of(first.samples));
    // A curve that starts at the same point but goes elsewhere is sampled anew.
    std::vector<surface::OutlineCurve> changed = curves;
    changed[0].curve = surface::SplineCurve({{curves[0].curve.at(0, 0), {3, 3}}, false});
    surface::SampledCurves unknown;
    EXPECT_EQ(spacings_of(surface::sample_spacings(changed, rule, known).samples),
              spacings_of(surface::sample_spacings(changed, rule, unknown).samples));
}

}  // namespace
}  // namespace lamina
