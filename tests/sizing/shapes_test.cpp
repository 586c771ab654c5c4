// Properties that every shape of size sources has, and the texts of shapes.
#include "sizing/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>

namespace lamina::sizing {
namespace {

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double real(double lower, double upper) {
        return lower + (upper - lower) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    Point in(const Box& box) { return {real(box.lower.x, box.upper.x), real(box.lower.y, box.upper.y)}; }

private:
    std::mt19937_64 engine_;
};

const Box near{{-1, -1}, {1, 1}}, around{{-4, -4}, {4, 4}};

/// Returns sources of every shape, each with and without a radius.
std::vector<SizeSource> every_shape(Random& random) {
    std::vector<SizeSource> sources;
    for (int i = 0; i < 20; ++i) {
        const Point a = random.in(near), b = random.in(near);
        Box box;
        box.include(a);
        box.include(b);
        for (const double radius : {0.0, random.real(0.01, 1)}) {
            sources.push_back({a, b, 0.1, radius});
            sources.push_back({a, a, 0.1, radius});
            sources.push_back({box.lower, box.upper, 0.1, radius, SizeSource::Shape::box});
            sources.push_back({a, a, 0.1, radius, SizeSource::Shape::box});
        }
    }
    return sources;
}

double distance_to_box(const Box& box, Point p) { return std::sqrt(core::squared_distance(box, p)); }

constexpr double rounding = 1e-12;

TEST(Shapes, DistancesAreZeroInsideAndGrowOutside) {
    Random random(1);
    for (const SizeSource& source : every_shape(random)) {
        EXPECT_EQ(shape_fault(source), nullptr);
        EXPECT_LE(lamina::distance_to(source, midpoint(source.a, source.b)), rounding);
        const Box box = bounding_box(source);
        for (int i = 0; i < 100; ++i) {
            const Point p = random.in(around), q = random.in(around);
            const double at_p = lamina::distance_to(source, p), at_q = lamina::distance_to(source, q);
            EXPECT_GE(at_p, 0);
            // The tree of boxes finds sources by their boxes, which are never further away than they are.
            EXPECT_GE(at_p, distance_to_box(box, p) - rounding);
            EXPECT_LE(std::abs(at_p - at_q), distance(p, q) + rounding);
            EXPECT_LE(lamina::distance_to(source, midpoint(p, q)), std::max(at_p, at_q) + rounding) << "not convex";
        }
    }
}

TEST(Shapes, SegmentsAndBoxesHoldTheirEnds) {
    for (const SizeSource::Shape shape : {SizeSource::Shape::segment, SizeSource::Shape::box}) {
        const SizeSource source{.a = {-1, 0.1}, .b = {0.7, 2}, .size = 0.1, .shape = shape};
        for (const Point end : {source.a, source.b}) EXPECT_LE(lamina::distance_to(source, end), rounding);
    }
}

TEST(Shapes, SeveralPointsAtOnceHaveTheSameDistances) {
    Random random(2);
    for (const SizeSource& source : every_shape(random)) {
        const SourceShape shape = prepare_shape(source);
        std::array<double, 6> x, y;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const Point p = random.in(around);
            x[k] = p.x;
            y[k] = p.y;
        }
        const std::array<double, 6> squared = squared_distances(shape, x, y);
        for (std::size_t k = 0; k < x.size(); ++k)
            EXPECT_EQ(std::max(std::sqrt(squared[k]) - source.radius, 0.0), lamina::distance_to(source, {x[k], y[k]}));
    }
}

TEST(Shapes, CoverBoxesWhosePointsTheyHold) {
    Random random(3);
    int covered = 0;
    for (const SizeSource& source : every_shape(random)) {
        const SourceShape shape = prepare_shape(source);
        for (int i = 0; i < 20; ++i) {
            const Point corner = random.in(bounding_box(source));
            const Box box{corner, corner + Point{random.real(0, 0.2), random.real(0, 0.2)}};
            const bool covers_box = covers(shape, box);
            covered += covers_box;
            for (int k = 0; covers_box && k < 20; ++k) EXPECT_LE(lamina::distance_to(source, random.in(box)), rounding);
            EXPECT_TRUE(has_inside(shape) || !covers_box);
        }
    }
    EXPECT_GT(covered, 100);
}

// The limits of the work count on these: they must not exceed the area by far.
TEST(Shapes, AreasInADomainAreAboutThoseOfPointsInside) {
    Random random(4);
    for (const SizeSource& source : every_shape(random)) {
        const bool is_point = source.shape == SizeSource::Shape::segment && source.a == source.b;
        if (source.radius > 0 && !is_point) continue;  // no text makes one
        const Box domain = bounding_box(source);
        const Extent extent = extent_in(domain, source);
        constexpr int count = 20'000;
        int inside = 0;
        for (int i = 0; i < count; ++i) inside += lamina::distance_to(source, random.in(domain)) == 0;
        const double area = domain.width() * domain.height(), expected = area * inside / count;
        EXPECT_NEAR(extent.area, expected, 0.03 * area);
        EXPECT_GE(extent.border, 0);
        EXPECT_EQ(extent_in({{10, 10}, {11, 11}}, source).area, 0);
        EXPECT_EQ(extent_in({{10, 10}, {11, 11}}, source).border, 0);
    }
}

TEST(Shapes, TextsReadBack) {
    for (const char* text : {"box:-1,0,0.5,2,0.1", "circle:1,2,0.25,1e-06", "line:3,2,-1,0,0.1"})
        EXPECT_EQ(size_source_text(parse_size_source(text)), text);
    EXPECT_EQ(size_source_text(parse_size_source("box:0.5,2,-1,0,0.1")), "box:-1,0,0.5,2,0.1");
    EXPECT_EQ(source_forms(), "box:X0,Y0,X1,Y1,H, circle:X,Y,R,H or line:X0,Y0,X1,Y1,H");
    const auto reason = [](const char* text) -> std::string {
        try {
            parse_size_source(text);
        } catch (const UsageError& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(reason("star:1"), "'star:1': a shape is " + source_forms());
    EXPECT_EQ(reason("box"), "'box': a shape is " + source_forms());
    EXPECT_EQ(reason("circle:1,2,3"), "'circle:1,2,3': a circle takes 4 numbers, not 3");
    EXPECT_EQ(reason("circle:1,2,0,1"), "'circle:1,2,0,1': the radius must be > 0");
    EXPECT_EQ(reason("line:1,2,0,1,0"), "'line:1,2,0,1,0': the edge length must be > 0");
}

}  // namespace
}  // namespace lamina::sizing
