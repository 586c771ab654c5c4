// Compares the size field with the exact minimum over its sources.
#include <lamina/sizing.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"

namespace lamina {
namespace {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double real(double lower = 0, double upper = 1) {
        return lower + (upper - lower) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    std::size_t index(std::size_t size) { return engine_() % size; }
    Point in(const Box& box) { return {real(box.lower.x, box.upper.x), real(box.lower.y, box.upper.y)}; }
    /// Returns a vector of any direction and of any magnitude.
    Point offset() {
        const double reach = std::pow(10.0, real(-7, 1.5));
        return {real(-reach, reach), real(-reach, reach)};
    }

private:
    std::mt19937_64 engine_;
};

const Box domain{{-20, -15}, {21, 17}};

/// Returns the exact minimum over the sources.
double exact(const std::vector<SizeSource>& sources, const SizeFieldOptions& options, Point p) {
    double smallest = options.max_size;
    for (const SizeSource& s : sources) {
        const Point along = s.b - s.a;
        const double t = squared_length(along) > 0 ? dot(p - s.a, along) / squared_length(along) : 0.0;
        Point nearest = s.a + std::clamp(t, 0.0, 1.0) * along;
        if (s.shape == SizeSource::Shape::box) nearest = {std::clamp(p.x, s.a.x, s.b.x), std::clamp(p.y, s.a.y, s.b.y)};
        smallest = std::min(smallest, s.size + options.gradation * std::max(distance(p, nearest) - s.radius, 0.0));
    }
    return smallest;
}

/// Returns the edges of a closed curve like the outer border of a layer, with their own lengths for sizes.
std::vector<SizeSource> closed_curve(int edges) {
    std::vector<Point> points;
    for (int i = 0; i < edges; ++i) {
        const double t = 2 * M_PI * i / edges;
        // The points are clustered at both ends, and the lower side is hollow.
        points.push_back({0.5 + 0.5 * std::cos(t), 0.06 * std::sin(t) * (t < M_PI ? 1 : std::cos(2 * t))});
    }
    std::vector<SizeSource> sources;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point a = points[i], b = points[(i + 1) % points.size()];
        sources.push_back({a, b, distance(a, b)});
    }
    return sources;
}

/// Returns points and short segments with sizes of all magnitudes.
std::vector<SizeSource> scattered(int count, Random& random) {
    std::vector<SizeSource> sources;
    for (int i = 0; i < count; ++i) {
        const double size = std::pow(10.0, random.real(-6, 0));
        const Point a{random.real(-2, 2), random.real(-2, 2)};
        sources.push_back({a, i % 3 == 0 ? a : a + Point{random.real(-size, size), random.real(-size, size)}, size});
    }
    return sources;
}

/// Returns points at all distances from the sources, two corners of the domain, and its centre.
std::vector<Point> probes(const std::vector<SizeSource>& sources, std::size_t count, Random& random) {
    std::vector<Point> points{domain.lower, domain.upper, domain.center()};
    while (points.size() < count) {
        const SizeSource& s = sources[random.index(sources.size())];
        const Point p = s.a + random.real() * (s.b - s.a) + random.offset();
        points.push_back(domain.contains(p) ? p : random.in(domain));
    }
    return points;
}

void expect_close_to_exact(const std::vector<SizeSource>& sources, const SizeFieldOptions& options, Random& random) {
    const SizeField field(sources, options, domain);
    double worst = 0, sum = 0;
    const std::vector<Point> points = probes(sources, 3000, random);
    for (const Point& p : points) {
        const double h = exact(sources, options, p);
        const double error = std::abs(field(p) - h) / h;
        worst = std::max(worst, error);
        sum += error;
    }
    EXPECT_LE(worst, SizeField::relative_error) << "gradation " << options.gradation;
    EXPECT_LE(sum / static_cast<double>(points.size()), 0.03) << "gradation " << options.gradation;
}

TEST(SizeField, CloseToExactRoundABorder) {
    Random random(1);
    const std::vector<SizeSource> sources = closed_curve(600);
    for (const double gradation : {0.0, 0.005, 0.05, 0.1, 0.2, 0.5, 1.0})
        expect_close_to_exact(sources, {.gradation = gradation}, random);
}

TEST(SizeField, CloseToExactForManySources) {
    Random random(11);
    expect_close_to_exact(closed_curve(20'000), {.gradation = 0.1}, random);
    expect_close_to_exact(scattered(5'000, random), {.gradation = 0.1}, random);
}

TEST(SizeField, CloseToExactForScatteredSources) {
    Random random(2);
    for (const int count : {1, 2, 7, 40, 300})
        for (const double gradation : {0.01, 0.1, 0.3})
            expect_close_to_exact(scattered(count, random), {.gradation = gradation}, random);
}

TEST(SizeField, CloseToExactForLongSources) {
    Random random(3);
    const std::vector<SizeSource> sources{{{-3, -2}, {9, 5}, 0.01}, {{0, 8}, {1, -12}, 0.05}, {{-30, 3}, {40, 3}, 0.4}};
    expect_close_to_exact(sources, {.gradation = 0.1}, random);
}

TEST(SizeField, CloseToExactUnderACap) {
    Random random(4);
    for (const double cap : {2e-3, 0.05, 1.0}) {
        expect_close_to_exact(closed_curve(300), {.gradation = 0.2, .max_size = cap}, random);
        expect_close_to_exact(scattered(50, random), {.gradation = 0.2, .max_size = cap}, random);
    }
}

TEST(SizeField, CloseToExactForAreas) {
    Random random(9);
    std::vector<SizeSource> sources;
    for (int i = 0; i < 30; ++i) {
        const Point a = random.in(domain);
        const double size = std::pow(10.0, random.real(-3, 0)), extent = std::pow(10.0, random.real(-2, 1));
        if (i % 2 == 0) {
            const Point b = a + Point{random.real(0, extent), random.real(0, extent)};
            sources.push_back({.a = a, .b = b, .size = size, .shape = SizeSource::Shape::box});
        } else {
            sources.push_back({.a = a, .b = a, .size = size, .radius = extent});
        }
    }
    for (const double gradation : {0.02, 0.1, 0.3}) {
        expect_close_to_exact(sources, {.gradation = gradation}, random);
        expect_close_to_exact({sources[0]}, {.gradation = gradation}, random);
        expect_close_to_exact({sources[1]}, {.gradation = gradation}, random);
    }
    const std::vector<SizeSource> scattered_too = scattered(100, random);
    sources.insert(sources.end(), scattered_too.begin(), scattered_too.end());
    expect_close_to_exact(sources, {.gradation = 0.1}, random);
}

// An area costs cells along its boundary, not inside.
TEST(SizeField, AreasAreConstantInside) {
    const std::vector<SizeSource> box{{.a = {-3, -2}, .b = {3, 2}, .size = 0.01, .shape = SizeSource::Shape::box}};
    const SizeField field(box, {.gradation = 0.1}, domain);
    EXPECT_LT(field.cells(), 60'000u);  // cells of 0.005 would have to be 1,000,000 to fill the box
    Random random(10);
    for (int i = 0; i < 1000; ++i) EXPECT_NEAR(field(random.in({{-2.98, -1.98}, {2.98, 1.98}})), 0.01, 1e-8);
}

// The field may jump between cells by no more than its error. Otherwise it grows by the gradation.
TEST(SizeField, NeighbouringValuesDifferLittle) {
    Random random(5);
    const std::vector<SizeSource> sources = closed_curve(600);
    const SizeFieldOptions options{.gradation = 0.15};
    const SizeField field(sources, options, domain);
    for (const Point& p : probes(sources, 20'000, random)) {
        const double h = field(p);
        const Point q = p + Point{random.real(-h, h), random.real(-h, h)};
        if (!domain.contains(q)) continue;
        const double tolerance = (1 + SizeField::relative_error) / (1 - SizeField::relative_error);
        const double growth = options.gradation * distance(p, q) / (h / (1 + SizeField::relative_error));
        EXPECT_LE(field(q) / h, (1 + growth) * tolerance);
    }
}

TEST(SizeField, PointsOutsideAreClampedToTheDomain) {
    Random random(6);
    const SizeField field(closed_curve(100), {.gradation = 0.1}, domain);
    const Box around{{-60, -60}, {60, 60}};
    for (int i = 0; i < 10'000; ++i) {
        const Point p = random.in(around);
        const Point inside{std::clamp(p.x, domain.lower.x, domain.upper.x),
                           std::clamp(p.y, domain.lower.y, domain.upper.y)};
        EXPECT_EQ(field(p), field(inside));
    }
    EXPECT_EQ(field({1e300, 1e300}), field(domain.upper));
}

TEST(SizeField, RestrictionChangesNoValue) {
    Random random(7);
    const std::vector<SizeSource> sources = closed_curve(400);
    const SizeField field(sources, {.gradation = 0.1}, domain);
    std::vector<Box> boxes{domain, {{-100, -100}, {100, 100}}, {{30, 30}, {31, 31}}, {{0.5, 0.1}, {0.5, 0.1}}};
    for (int i = 0; i < 40; ++i) {
        Box box;
        const Point corner = sources[random.index(sources.size())].a + random.offset();
        box.include(corner);
        box.include(corner + random.offset());
        boxes.push_back(box);
    }
    for (const Box& box : boxes) {
        const SizeField restricted = field.restricted_to(box);
        const SizeField twice = restricted.restricted_to(domain);
        EXPECT_EQ(restricted.cells(), field.cells());
        for (int i = 0; i < 500; ++i) {
            const Point p = random.in(i % 2 == 0 ? box : domain);
            ASSERT_EQ(restricted(p), field(p));
            ASSERT_EQ(twice(p), field(p));
        }
    }
}

// Many sources lie at the same place or have the same middle, and some are given twice.
TEST(SizeField, DependsNeitherOnTheOrderOfSourcesNorOnThreads) {
    Random random(8);
    std::vector<SizeSource> sources = closed_curve(3000);
    for (int i = 0; i < 3000; ++i) {
        const Point p{0.25 * double(random.index(12)), 0.25 * double(random.index(12))};
        const double size = 0.01 * double(1 + random.index(3)), off = 0.1 * double(random.index(3));
        sources.push_back({p - Point{off, 0}, p + Point{off, 0}, size, off});
        sources.push_back({p - Point{0, off}, p + Point{0, off}, size, off});
    }
    const SizeField field(sources, {.gradation = 0.1}, domain);
    const std::vector<Point> points = probes(sources, 20'000, random);
    for (unsigned threads : {1u, 2u, 5u})
        for (int round = 0; round < 3; ++round) {
            for (std::size_t i = sources.size(); i > 1; --i) std::swap(sources[i - 1], sources[random.index(i)]);
            with_threads(threads, [&] {
                const SizeField again(sources, {.gradation = 0.1}, domain);
                EXPECT_EQ(again.cells(), field.cells());
                for (const Point& p : points) ASSERT_EQ(again(p), field(p));
            });
        }
}

TEST(SizeField, Uniform) {
    const SizeField field(0.25);
    EXPECT_EQ(field({3, -4}), 0.25);
    EXPECT_EQ(field.restricted_to(domain)({1e9, 0}), 0.25);
    EXPECT_EQ(field.cells(), 1u);
    const SizeField capped({}, {.gradation = 0.1, .max_size = 3}, domain);
    EXPECT_NEAR(capped({1, 2}), 3, 1e-5);
    EXPECT_LE(capped.cells(), 16u);
}

TEST(SizeField, IntegralOfItsInverseSquare) {
    const SizeField capped({}, {.gradation = 0.1, .max_size = 0.5}, domain);
    const double area = domain.width() * domain.height();
    EXPECT_NEAR(capped.inverse_square_integral(), 4 * area, 1e-5 * area);
    // The reference is the mean over points everywhere.
    Random random(12);
    const std::vector<SizeSource> sources{{{-3, -2}, {9, 5}, 1}, {{0, 8}, {1, -12}, 2}};
    const SizeField field(sources, {.gradation = 0.3}, domain);
    double sum = 0;
    constexpr int count = 200'000;
    for (int i = 0; i < count; ++i) {
        const double h = field(random.in(domain));
        sum += 1 / (h * h);
    }
    const double expected = area * sum / count;
    EXPECT_NEAR(field.inverse_square_integral(), expected, 0.02 * expected);
}

// The tree has few cells where the field is nearly flat, and no more than a few dozen per source elsewhere.
TEST(SizeField, CellsAreFew) {
    const std::vector<SizeSource> sources = closed_curve(1000);
    const Box far{{-100, -100}, {101, 100}};
    EXPECT_LT(SizeField(sources, {.gradation = 0.005}, far).cells(), 8'000u);
    EXPECT_LT(SizeField(sources, {.gradation = 0.1}, far).cells(), 40'000u);
}

TEST(SizeField, RefusesInvalidArguments) {
    const std::vector<SizeSource> one{{{0, 0}, {1, 0}, 0.1}};
    const std::vector<SizeSource> zero{{{0, 0}, {1, 0}, 0.0}};
    EXPECT_THROW(SizeField(0.0), UsageError);
    EXPECT_THROW(SizeField(-1.0), UsageError);
    EXPECT_THROW(SizeField{HUGE_VAL}, UsageError);
    EXPECT_THROW(SizeField(std::nan("")), UsageError);
    EXPECT_THROW(SizeField(zero, {}, domain), UsageError);
    const SizeSource inside_out{.a = {1, 1}, .b = {0, 0}, .size = 0.1, .shape = SizeSource::Shape::box};
    const SizeSource hole{.a = {0, 0}, .b = {0, 0}, .size = 0.1, .radius = -1};
    EXPECT_THROW(SizeField(std::span(&inside_out, 1), {}, domain), UsageError);
    EXPECT_THROW(SizeField(std::span(&hole, 1), {}, domain), UsageError);
    EXPECT_THROW(SizeField(one, {.gradation = -0.1}, domain), UsageError);
    EXPECT_THROW(SizeField(one, {.gradation = std::nan("")}, domain), UsageError);
    EXPECT_THROW(SizeField(one, {.max_size = 0}, domain), UsageError);
    EXPECT_THROW(SizeField({}, {}, domain), UsageError);
    EXPECT_THROW(SizeField(one, {}, Box{}), UsageError);
}

}  // namespace
}  // namespace lamina
