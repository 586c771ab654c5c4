// The predicates against exact integer arithmetic, on 1.4 million quadruples of points that are hard to decide.
#include <lamina/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include "core/predicates.hpp"

namespace lamina {
namespace {

namespace mp = boost::multiprecision;
using Integer = mp::number<mp::cpp_int_backend<1024, 0, mp::signed_magnitude, mp::unchecked>, mp::et_off>;
using Quadruple = std::array<Point, 4>;

template <class Number>
int sign_of(const Number& x) {
    return (x > 0) - (x < 0);
}

struct IntegerPoint {
    Integer x, y;
};

/// Returns the points times a common power of two that makes their coordinates integers, which changes no sign.
std::array<IntegerPoint, 4> to_integers(const Quadruple& p) {
    struct Parts {
        std::int64_t mantissa = 0;
        int exponent = 0;
    };
    const auto parts = [](double c) {
        Parts result;
        result.mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(c, &result.exponent), 53));
        for (; result.mantissa != 0 && result.mantissa % 2 == 0; ++result.exponent) result.mantissa /= 2;
        return result;
    };
    int min_exponent = std::numeric_limits<int>::max();
    for (const Point& q : p)
        for (const double c : {q.x, q.y})
            if (c != 0) min_exponent = std::min(min_exponent, parts(c).exponent);
    const auto scaled = [&](double c) {
        const Parts part = parts(c);
        Integer result = part.mantissa;
        if (part.mantissa != 0) result <<= part.exponent - min_exponent;
        return result;
    };
    std::array<IntegerPoint, 4> result;
    for (int i = 0; i < 4; ++i) result[i] = {scaled(p[i].x), scaled(p[i].y)};
    return result;
}

int exact_orient2d(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c) {
    const Integer left = (a.x - c.x) * (b.y - c.y);
    const Integer right = (a.y - c.y) * (b.x - c.x);
    return left.compare(right);
}

int exact_incircle(const std::array<IntegerPoint, 4>& p) {
    std::array<Integer, 3> x, y, lift;
    for (int i = 0; i < 3; ++i) {
        x[i] = p[i].x - p[3].x;
        y[i] = p[i].y - p[3].y;
        lift[i] = x[i] * x[i] + y[i] * y[i];
    }
    const Integer det = lift[0] * (x[1] * y[2] - y[1] * x[2]) + lift[1] * (x[2] * y[0] - y[2] * x[0]) +
                        lift[2] * (x[0] * y[1] - y[0] * x[1]);
    return sign_of(det);
}

/// Returns the sign of core::flattened_turn() of the first three points over a cut through the fourth.
int exact_flattened_turn(const std::array<IntegerPoint, 4>& p) {
    const auto height = [&](const IntegerPoint& q) -> Integer { return (q.x - p[3].x) * (q.x - p[3].x) + q.y * q.y; };
    const Integer left = (p[1].y - p[0].y) * (height(p[2]) - height(p[0]));
    const Integer right = (p[2].y - p[0].y) * (height(p[1]) - height(p[0]));
    return left.compare(right);
}

/// Returns the sign of incircle_perturbed() for points with small integer coordinates, by numbers instead of
/// infinitesimals: the lifted heights are lowered by fractions that differ by factors too large for any cofactor, and
/// the 4 x 4 determinant is summed over all permutations.
int lowered_incircle(const Quadruple& p) {
    std::array<int, 4> rank{};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) rank[i] += lexicographically_less(p[j], p[i]);
    std::array<std::array<Integer, 4>, 4> row;
    for (int i = 0; i < 4; ++i) {
        const auto x = static_cast<std::int64_t>(p[i].x), y = static_cast<std::int64_t>(p[i].y);
        row[i] = {Integer(x), Integer(y), (Integer(x * x + y * y) << 200) - (Integer(1) << (50 * (3 - rank[i]))),
                  Integer(1)};
    }
    std::array<int, 4> column{0, 1, 2, 3};
    Integer det = 0;
    do {
        int inversions = 0;
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j) inversions += column[i] > column[j];
        const Integer product = row[0][column[0]] * row[1][column[1]] * row[2][column[2]] * row[3][column[3]];
        det += inversions % 2 == 0 ? product : Integer(-product);
    } while (std::next_permutation(column.begin(), column.end()));
    return sign_of(det);
}

/// Random numbers and points.
class PointSource {
public:
    explicit PointSource(std::uint64_t seed) : engine_(seed) {}
    int integer(int lower, int upper) {
        return lower + static_cast<int>(engine_() % static_cast<std::uint64_t>(upper - lower + 1));
    }
    double real(double lower = -1, double upper = 1) {
        return lower + (upper - lower) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    Point point(double scale = 1) { return {scale * real(), scale * real()}; }
    /// Returns a random power of ten in a third of the calls, else 1.
    double scale() { return integer(0, 2) == 0 ? std::pow(10.0, integer(-57, 59)) : 1.0; }
    /// Returns the point with each coordinate moved by up to `ulps` units in the last place.
    Point nudged(Point p, int ulps) {
        for (double* c : {&p.x, &p.y})
            for (int n = integer(-ulps, ulps); n != 0; n += n < 0 ? 1 : -1)
                *c = std::nextafter(*c, n < 0 ? -HUGE_VAL : HUGE_VAL);
        return p;
    }

private:
    std::mt19937_64 engine_;
};

/// Returns points moved back into the exact range, which scaling and nudging may leave.
Quadruple clamped(Quadruple p) {
    for (Point& q : p)
        for (double* c : {&q.x, &q.y}) {
            if (std::abs(*c) < min_exact_coordinate) *c = 0;
            *c = std::clamp(*c, -max_exact_coordinate, max_exact_coordinate);
        }
    return p;
}

Quadruple near_collinear(PointSource& random) {
    const double scale = random.scale();
    const Point a = random.point(scale),
                b = random.integer(0, 1) ? random.point(scale) : a + random.point(1e-9 * scale);
    const auto on_line = [&] { return random.nudged(a + random.real(-2, 2) * (b - a), 2); };
    return {a, b, on_line(), on_line()};
}

Quadruple near_cocircular(PointSource& random) {
    const double scale = random.scale();
    const Point center = random.point(scale);
    const double radius = scale * std::pow(10.0, random.integer(-6, 1));
    Quadruple p;
    for (Point& q : p) {
        const double t = random.real(-5, 5);  // rational parametrisation of the circle
        q = random.nudged(center + (radius / (1 + t * t)) * Point{1 - t * t, 2 * t}, random.integer(0, 2));
    }
    return p;
}

Quadruple lattice(PointSource& random) {
    const std::array<double, 6> steps{1, 0.1, 1.0 / 3, 1e-60, 1e58, 0.7e-5};
    const double step = steps[static_cast<std::size_t>(random.integer(0, 5))];
    const int extent = random.integer(1, 40);
    Quadruple p;
    for (Point& q : p) q = {step * random.integer(-extent, extent), step * random.integer(-extent, extent)};
    return p;
}

/// Returns rectangles and mirror images with full mantissas, which are exactly cocircular before one point is nudged.
Quadruple symmetric(PointSource& random) {
    const double scale = random.scale();
    const Point a = random.point(scale),
                b = random.integer(0, 1) ? random.point(scale) : a + random.point(1e-7 * scale);
    Quadruple p;
    switch (random.integer(0, 2)) {
        case 0:
            p = {a, {b.x, a.y}, b, {a.x, b.y}};
            break;
        case 1:
            p = {a, {a.x, -a.y}, {b.x, -b.y}, b};
            break;
        default:
            p = {a, {-a.x, a.y}, {-b.x, b.y}, b};
            break;
    }
    if (random.integer(0, 1)) p[3] = random.nudged(p[3], 1);
    return p;
}

/// Returns points on a circle whose centre lies on the cut through the fourth point. Their flattened images lie on a
/// line before one point is nudged.
Quadruple centred_on_cut(PointSource& random) {
    const std::array<Point, 8> circle{Point{3, 4}, {4, 3}, {5, 0}, {4, -3}, {-3, 4}, {-5, 0}, {0, 5}, {0, -5}};
    const double scale = std::ldexp(random.scale(), random.integer(-3, 3));
    const Point center = random.integer(0, 1) ? Point{} : Point{8 * scale, 1024 * scale};
    Quadruple p;
    for (Point& q : p) q = center + scale * circle[static_cast<std::size_t>(random.integer(0, 7))];
    p[3].x = center.x;
    if (random.integer(0, 1)) p[2] = random.nudged(p[2], 1);
    return p;
}

/// Returns points whose coordinates have independent magnitudes in the whole range; some coordinates are equal or 0.
Quadruple mixed_magnitudes(PointSource& random) {
    const auto coordinate = [&] {
        const double magnitude = random.real(1, 10) * std::pow(10.0, random.integer(-60, 59));
        return random.integer(0, 9) == 0 ? 0.0 : random.integer(0, 1) ? magnitude : -magnitude;
    };
    Quadruple p;
    for (Point& q : p) q = {coordinate(), coordinate()};
    if (random.integer(0, 1)) p[1].x = p[0].x;
    if (random.integer(0, 1)) p[2].y = p[1].y;
    if (random.integer(0, 3) == 0) p[3] = {p[0].x, p[2].y};
    return p;
}

/// Returns points whose differences have few bits and tails far below them, for which the last, exact stage is made.
Quadruple large_offset(PointSource& random) {
    const Point offset = random.point(std::pow(10.0, random.integer(0, 12)));
    const double tiny = std::pow(10.0, random.integer(-30, -8));
    const std::array<Point, 8> circle{Point{3, 4}, {4, 3}, {5, 0}, {4, -3}, {-3, 4}, {-5, 0}, {0, 5}, {0, -5}};
    Quadruple p;
    for (Point& q : p) q = random.nudged(offset + circle[static_cast<std::size_t>(random.integer(0, 7))], 1);
    p[static_cast<std::size_t>(random.integer(0, 3))] = random.point(tiny);
    return p;
}

/// Counts over the cases of one generator.
struct Tally {
    int wrong = 0;            ///< cases with a wrong sign
    int filter_failures = 0;  ///< cases that the filter of incircle() could not decide
    int ties = 0;             ///< cocircular points
    int flat_ties = 0;        ///< points whose flattened images lie on a line
};

/// Returns whether core::flattened_turn() is right for the first three points, in ascending order of y, over a cut
/// through the fourth.
bool flattened_turn_is_right(Quadruple p, Tally& tally) {
    std::sort(p.begin(), p.begin() + 3, [](Point a, Point b) { return a.y < b.y; });
    if (p[0].y == p[1].y || p[1].y == p[2].y) return true;
    const int turn = exact_flattened_turn(to_integers(p));
    tally.flat_ties += turn == 0;
    return sign_of(core::flattened_turn(p[0], p[1], p[2], p[3].x)) == turn &&
           sign_of(core::flattened_turn_after_filter(p[0], p[1], p[2], p[3].x)) == turn;
}

/// Compares all predicates with exact arithmetic on generated points.
template <class Generator>
Tally compare(Generator generate, int cases, std::uint64_t seed) {
    PointSource random(seed);
    Tally tally;
    for (int n = 0; n < cases; ++n) {
        const Quadruple p = clamped(generate(random));
        const std::array<IntegerPoint, 4> q = to_integers(p);
        const int turn = exact_orient2d(q[0], q[1], q[2]), inside = exact_incircle(q);
        const int perturbed = sign_of(incircle_perturbed(p[0], p[1], p[2], p[3]));
        const bool right =
            sign_of(orient2d(p[0], p[1], p[2])) == turn && sign_of(incircle(p[0], p[1], p[2], p[3])) == inside &&
            (inside == 0 || perturbed == inside) &&
            sign_of(core::incircle_after_filter(p[0], p[1], p[2], p[3])) == perturbed &&
            sign_of(core::orient2d_after_filter(p[0], p[1], p[2])) == turn && flattened_turn_is_right(p, tally);
        if (!right && tally.wrong++ == 0)
            ADD_FAILURE() << std::hexfloat << p[0].x << ' ' << p[0].y << "  " << p[1].x << ' ' << p[1].y << "  "
                          << p[2].x << ' ' << p[2].y << "  " << p[3].x << ' ' << p[3].y << ": orient2d should be "
                          << turn << ", incircle " << inside;
        tally.filter_failures += !core::rounded_incircle(p[0], p[1], p[2], p[3]).certain();
        tally.ties += inside == 0;
    }
    return tally;
}

constexpr int cases = 80'000;

TEST(Predicates, NearCollinear) { EXPECT_EQ(compare(near_collinear, cases, 1).wrong, 0); }

TEST(Predicates, NearCocircular) {
    const Tally tally = compare(near_cocircular, cases, 2);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.filter_failures, cases / 10);
}

TEST(Predicates, Lattice) {
    const Tally tally = compare(lattice, cases, 3);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.ties, cases / 40);
    EXPECT_GT(tally.flat_ties, 40);
}

TEST(Predicates, Symmetric) {
    const Tally tally = compare(symmetric, cases, 4);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.ties, cases / 3);
    EXPECT_GT(tally.filter_failures, tally.ties);
}

TEST(Predicates, CentredOnCut) {
    const Tally tally = compare(centred_on_cut, cases, 9);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.flat_ties, cases / 20);
}

TEST(Predicates, MixedMagnitudes) {
    const Tally tally = compare(mixed_magnitudes, cases, 5);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.filter_failures, cases / 20);
}

TEST(Predicates, LargeOffset) { EXPECT_EQ(compare(large_offset, cases, 6).wrong, 0); }

TEST(Predicates, EndsOfTheRange) {
    const double big = max_exact_coordinate, small = min_exact_coordinate;
    EXPECT_GT(incircle({-big, -big}, {big, -big}, {big, big}, {small, -small}), 0);
    EXPECT_EQ(incircle({-big, -big}, {big, -big}, {big, big}, {-big, big}), 0);
    EXPECT_LT(incircle({-big, -big}, {big, -big}, {big, std::nextafter(big, 0)}, {-big, big}), 0);
    EXPECT_EQ(incircle({-small, -small}, {small, -small}, {small, small}, {-small, small}), 0);
    EXPECT_GT(incircle({-small, -small}, {small, -small}, {small, small}, {small, 0}), 0);
    // Four points of the finest lattice make the smallest determinant.
    const double ulp = std::nextafter(small, 1) - small;
    EXPECT_LT(incircle({small, small}, {small + ulp, small}, {small, small + ulp}, {small + ulp, small + 2 * ulp}), 0);
    EXPECT_EQ(incircle({small, small}, {small + ulp, small}, {small, small + ulp}, {small + ulp, small + ulp}), 0);
    EXPECT_GT(orient2d({small, small}, {small + ulp, small}, {small, small + ulp}), 0);
}

TEST(Predicates, ComparedDistances) {
    std::mt19937_64 random(11);
    std::uniform_int_distribution<int> exponent(-40, 40), ulps(-2, 2), small(-9, 9);
    std::uniform_real_distribution<double> unit(-1, 1);
    int ties = 0;
    for (int n = 0; n < 100000; ++n) {
        // Points mirrored about p, then moved by a few ulps: nearly, and often exactly, as far.
        const Point p = n % 2 == 0 ? Point{double(small(random)), double(small(random))}
                                   : std::ldexp(1.0, exponent(random)) * Point{unit(random), unit(random)};
        const Point d =
            n % 4 < 2 ? Point{double(small(random)), double(small(random))} : Point{unit(random), unit(random)};
        const Point a = p + d;
        Point b = n % 3 == 0 ? p - d : p + perpendicular(d);
        b.x *= 1 + ulps(random) * 0x1p-52;
        const auto [pi, ai, bi, unused] = to_integers({p, a, b, p});
        const auto squared = [from = pi](const IntegerPoint& q) {
            return Integer((q.x - from.x) * (q.x - from.x) + (q.y - from.y) * (q.y - from.y));
        };
        const Integer difference = squared(ai) - squared(bi);
        ties += difference == 0;
        ASSERT_EQ(sign_of(core::compare_distances(p, a, b)), sign_of(difference));
    }
    EXPECT_GT(ties, 1000);
}

TEST(Predicates, ExactRange) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double c : {0.0, -0.0, 1.0, -1e60, 1e60, 1e-60, -1e-60}) EXPECT_TRUE(in_exact_range({c, 1})) << c;
    for (const double c : {1.1e60, -HUGE_VAL, HUGE_VAL, nan, 0.9e-60, std::numeric_limits<double>::denorm_min()}) {
        EXPECT_FALSE(in_exact_range({c, 1})) << c;
        EXPECT_FALSE(in_exact_range({1, c})) << c;
    }
}

// Like the determinants that they are signs of, both incircle predicates change sign with every exchange of two points,
// and orient2d() keeps its sign under rotation.
TEST(Predicates, Permutations) {
    PointSource random(7);
    for (int n = 0; n < 20'000; ++n) {
        const Quadruple p = clamped(n % 2 == 0 ? symmetric(random) : lattice(random));
        const int turn = sign_of(orient2d(p[0], p[1], p[2]));
        EXPECT_EQ(sign_of(orient2d(p[1], p[2], p[0])), turn);
        EXPECT_EQ(sign_of(orient2d(p[1], p[0], p[2])), -turn);
        const int inside = sign_of(incircle(p[0], p[1], p[2], p[3]));
        const int perturbed = sign_of(incircle_perturbed(p[0], p[1], p[2], p[3]));
        bool distinct = true;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) distinct = distinct && !(p[i] == p[j]);
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) {
                Quadruple q = p;
                std::swap(q[i], q[j]);
                EXPECT_EQ(sign_of(incircle(q[0], q[1], q[2], q[3])), -inside);
                if (distinct) {
                    EXPECT_EQ(sign_of(incircle_perturbed(q[0], q[1], q[2], q[3])), -perturbed);
                }
            }
    }
}

// The tie rule holds for every ordered choice of four points of a lattice.
TEST(Predicates, TieRuleOnALattice) {
    std::vector<Point> points;
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y) points.push_back({static_cast<double>(x), static_cast<double>(y)});
    int ties = 0;
    for (const Point& a : points)
        for (const Point& b : points)
            for (const Point& c : points)
                for (const Point& d : points) {
                    if (a == b || a == c || a == d || b == c || b == d || c == d) continue;
                    const int perturbed = sign_of(incircle_perturbed(a, b, c, d));
                    ASSERT_EQ(perturbed, lowered_incircle({a, b, c, d}));
                    if (orient2d(a, b, c) != 0) {
                        ASSERT_NE(perturbed, 0);
                    }
                    ties += incircle(a, b, c, d) == 0;
                }
    EXPECT_GT(ties, 2000);
}

// In the sense of the tie rule, a triangle of a cocircular polygon has an empty circle if and only if it belongs to the
// fan from the lexicographically smallest vertex.
TEST(Predicates, CocircularPolygonsAreFannedFromTheSmallestVertex) {
    // These are the integer points of the circle of radius 65, counter-clockwise from (65, 0).
    std::vector<Point> circle;
    for (int x = -65; x <= 65; ++x)
        for (int y = -65; y <= 65; ++y)
            if (x * x + y * y == 65 * 65) circle.push_back({static_cast<double>(x), static_cast<double>(y)});
    ASSERT_EQ(circle.size(), 36u);
    std::sort(circle.begin(), circle.end(), [](Point p, Point q) {
        const bool p_low = p.y < 0, q_low = q.y < 0;
        return p_low != q_low ? q_low : p_low ? p.x < q.x : p.x > q.x;
    });
    PointSource random(8);
    for (int n = 0; n < 300; ++n) {
        std::vector<Point> polygon;
        for (const Point& p : circle)
            if (random.integer(0, 2) == 0) polygon.push_back(p + Point{1000, 0});
        const auto size = static_cast<int>(polygon.size());
        const auto vertex = [&](int i) { return polygon[static_cast<std::size_t>(i)]; };
        const auto smallest = static_cast<int>(
            std::min_element(polygon.begin(), polygon.end(), lexicographically_less) - polygon.begin());
        for (int i = 0; i < size; ++i)
            for (int j = i + 1; j < size; ++j)
                for (int k = j + 1; k < size; ++k) {
                    ASSERT_GT(orient2d(vertex(i), vertex(j), vertex(k)), 0);
                    bool empty = true;
                    for (int l = 0; l < size; ++l)
                        if (l != i && l != j && l != k)
                            empty = empty && incircle_perturbed(vertex(i), vertex(j), vertex(k), vertex(l)) < 0;
                    // A triangle of the fan has the smallest vertex and two that follow each other in the polygon.
                    const bool at_i = i == smallest && k == j + 1, at_k = k == smallest && j == i + 1;
                    const bool at_j = j == smallest && i == 0 && k == size - 1;
                    ASSERT_EQ(empty, at_i || at_j || at_k);
                }
    }
}

}  // namespace
}  // namespace lamina
