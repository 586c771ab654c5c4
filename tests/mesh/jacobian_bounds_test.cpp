// Bounds of the determinants of cells of higher order, against samples and against rational arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "mesh/cell_lattice.hpp"
#include "mesh/determinant_rule.hpp"
#include "mesh/jacobian_bounds.hpp"

namespace lamina::mesh {
namespace {

constexpr std::array<unsigned, 2> every_shape{3, 4};

/// A fraction in lowest terms.
struct Fraction {
    __extension__ using Whole = __int128;
    Whole over = 0, under = 1;

    Fraction(long whole) : over(whole) {}
    Fraction(Whole a, Whole b) {
        Whole x = a < 0 ? -a : a, y = b < 0 ? -b : b;
        while (y != 0) x = std::exchange(y, x % y);
        over = (b < 0 ? -a : a) / x;
        under = (b < 0 ? -b : b) / x;
    }
    friend Fraction operator+(Fraction a, Fraction b) {
        return {a.over * b.under + b.over * a.under, a.under * b.under};
    }
    friend Fraction operator-(Fraction a, Fraction b) {
        return {a.over * b.under - b.over * a.under, a.under * b.under};
    }
    friend Fraction operator*(Fraction a, Fraction b) { return {a.over * b.over, a.under * b.under}; }
    friend Fraction operator/(Fraction a, Fraction b) { return {a.over * b.under, a.under * b.over}; }
    explicit operator double() const { return static_cast<double>(over) / static_cast<double>(under); }
};

/// A function of one variable and its derivative.
template <class Number>
struct Value {
    Number f, derivative;
};

/// Returns Lagrange's polynomial that is 1 at node i of 0, 1/p, ..., count/p and 0 at the others.
template <class Number>
Value<Number> lagrange_on(unsigned p, unsigned count, unsigned i, Number t) {
    Value<Number> product{Number(1), Number(0)};
    for (unsigned k = 0; k <= count; ++k) {
        if (k == i) continue;
        const Number slope = Number(static_cast<long>(p)) / Number(static_cast<long>(i) - static_cast<long>(k));
        const Number factor = slope * (t - Number(static_cast<long>(k)) / Number(static_cast<long>(p)));
        product = {product.f * factor, product.derivative * factor + product.f * slope};
    }
    return product;
}

template <class Number>
struct Coordinates {
    Number x, y;
};

/// Returns the determinant of a cell at a point, from products of Lagrange's polynomials.
template <class Number>
Number determinant_at(unsigned corners, unsigned p, const std::vector<Coordinates<Number>>& nodes, Number u, Number v) {
    const std::span<const LatticePlace> lattice = lattice_of_cell(corners, p);
    const Number zero(0);
    Number xu = zero, xv = zero, yu = zero, yv = zero;
    for (std::size_t n = 0; n < lattice.size(); ++n) {
        const auto [i, j] = lattice[n];
        Number du = zero, dv = zero;
        if (corners == 4) {
            const auto a = lagrange_on(p, p, i, u), b = lagrange_on(p, p, j, v);
            du = a.derivative * b.f;
            dv = a.f * b.derivative;
        } else {
            const unsigned k = p - i - j;
            const auto a = lagrange_on(p, i, i, u), b = lagrange_on(p, j, j, v),
                       c = lagrange_on(p, k, k, Number(1) - u - v);
            du = b.f * (a.derivative * c.f - a.f * c.derivative);
            dv = a.f * (b.derivative * c.f - b.f * c.derivative);
        }
        xu = xu + du * nodes[n].x;
        xv = xv + dv * nodes[n].x;
        yu = yu + du * nodes[n].y;
        yv = yv + dv * nodes[n].y;
    }
    return xu * yv - yu * xv;
}

/// Calls f with the determinant at all points of a grid of so many steps.
template <class Number, class F>
void sample_determinant(unsigned corners, unsigned p, const std::vector<Coordinates<Number>>& nodes, long steps,
                        F&& f) {
    for (long i = 0; i <= steps; ++i)
        for (long j = 0; j <= (corners == 3 ? steps - i : steps); ++j)
            f(determinant_at(corners, p, nodes, Number(i) / Number(steps), Number(j) / Number(steps)));
}

std::vector<Point> points_of(const std::vector<Coordinates<double>>& nodes) {
    std::vector<Point> points;
    for (const auto& node : nodes) points.push_back({node.x, node.y});
    return points;
}

/// Returns a cell of random shape, whose nodes are off their places by a random share of a step.
std::vector<Coordinates<double>> random_cell(unsigned corners, unsigned p, core::Random& random) {
    const double stretch = std::pow(10, random.real(-5, 0)), angle = random.real(0, 7), lean = random.real(-0.3, 0.3);
    const double noise = random.real(0, 0.6) / p, c = std::cos(angle), s = std::sin(angle);
    const Point origin{random.real(-3, 3), random.real(-3, 3)};
    std::vector<Coordinates<double>> nodes;
    for (const auto [i, j] : lattice_of_cell(corners, p)) {
        const double u = static_cast<double>(i) / p + noise * random.real(-0.5, 0.5);
        const double v = stretch * (static_cast<double>(j) / p + noise * random.real(-0.5, 0.5) + lean * u);
        nodes.push_back({origin.x + c * u - s * v, origin.y + s * u + c * v});
    }
    return nodes;
}

TEST(JacobianBounds, HoldForSamplesOfRandomCells) {
    core::Random random(1);
    std::array<std::size_t, 3> verdicts{};
    for (int round = 0; round < 600; ++round)
        for (const unsigned corners : every_shape)
            for (unsigned p = 1; p <= max_cell_order; ++p) {
                const auto nodes = random_cell(corners, p, random);
                const JacobianBounds bounds = bound_jacobian(corners, p, points_of(nodes));
                ++verdicts[static_cast<std::size_t>(bounds.verdict)];
                double smallest = HUGE_VAL, largest = -HUGE_VAL;
                sample_determinant(corners, p, nodes, 12, [&](double value) {
                    smallest = std::min(smallest, value);
                    largest = std::max(largest, value);
                });
                const double rounding = 1e-11;  // of the samples, in the longest edges
                EXPECT_LE(largest, bounds.upper + rounding);
                if (bounds.verdict == CellVerdict::valid) {
                    EXPECT_GT(bounds.lower, 0);
                    EXPECT_GE(smallest, bounds.lower - rounding);
                } else if (bounds.verdict == CellVerdict::invalid) {
                    EXPECT_LT(smallest, 0.1 * largest + rounding) << corners << " corners, order " << p;
                }
            }
    EXPECT_GT(verdicts[0], 1500u);
    EXPECT_GT(verdicts[1], 500u);
    EXPECT_EQ(verdicts[2], 0u);
}

TEST(JacobianBounds, OfSeveralCellsAreThoseOfEach) {
    core::Random random(7);
    for (int round = 0; round < 200; ++round)
        for (const unsigned corners : every_shape)
            for (unsigned p = 1; p <= max_cell_order; ++p) {
                JacobianBatch batch;
                std::vector<std::vector<Point>> cells;
                const std::size_t size = 1 + random.below(JacobianBatch::capacity);
                for (std::size_t i = 0; i < size; ++i) {
                    cells.push_back(points_of(random_cell(corners, p, random)));
                    if (random.below(10) == 0) cells.back()[0] = {1e200, 1e200};  // of which nothing is proved
                    for (std::size_t n = 0; n < cells.back().size(); ++n) batch.put(n, cells.back()[n]);
                    batch.add_cell();
                }
                const auto bounds = bound_jacobians(corners, p, batch);
                for (std::size_t i = 0; i < size; ++i) {
                    const JacobianBounds alone = bound_jacobian(corners, p, cells[i]);
                    EXPECT_EQ(bounds[i].verdict, alone.verdict);
                    EXPECT_EQ(bounds[i].lower, alone.lower);
                    EXPECT_EQ(bounds[i].upper, alone.upper);
                }
            }
}

TEST(JacobianBounds, AgreeWithRationalArithmetic) {
    core::Random random(2);
    std::size_t valid = 0, invalid = 0;
    for (int round = 0; round < 25; ++round)
        for (const unsigned corners : every_shape)
            for (unsigned p = 1; p <= max_cell_order; ++p) {
                std::vector<Coordinates<Fraction>> exact;
                std::vector<Point> nodes;
                const auto whole = [&](unsigned i) { return static_cast<long>(12 * i + random.below(9)) - 4; };
                for (const auto [i, j] : lattice_of_cell(corners, p)) {
                    const long x = whole(i), y = whole(j);
                    exact.push_back({x, y});
                    nodes.push_back({static_cast<double>(x), static_cast<double>(y)});
                }
                const JacobianBounds bounds = bound_jacobian(corners, p, nodes);
                double smallest = HUGE_VAL, largest = -HUGE_VAL;
                sample_determinant<Fraction>(corners, p, exact, 8, [&](Fraction value) {
                    smallest = std::min(smallest, static_cast<double>(value));
                    largest = std::max(largest, static_cast<double>(value));
                });
                EXPECT_LE(largest, bounds.upper);
                // Whole coordinates make determinants that are 0 at a corner, which no rounding decides.
                if (bounds.verdict == CellVerdict::unproved) {
                    EXPECT_EQ(smallest, 0);
                }
                valid += bounds.verdict == CellVerdict::valid;
                invalid += bounds.verdict == CellVerdict::invalid;
                if (bounds.verdict == CellVerdict::valid) {
                    EXPECT_GE(smallest, bounds.lower);
                }
                if (smallest < 0) {
                    EXPECT_EQ(bounds.verdict, CellVerdict::invalid);
                } else if (bounds.verdict == CellVerdict::invalid) {
                    double finer = HUGE_VAL;
                    sample_determinant<Fraction>(corners, p, exact, 48, [&](Fraction value) {
                        finer = std::min(finer, static_cast<double>(value));
                    });
                    EXPECT_LT(finer, 0) << corners << " corners, order " << p;
                }
            }
    EXPECT_GT(valid, 50u);
    EXPECT_GT(invalid, 20u);
}

/// Returns a cell of evenly spaced nodes at a place, by products of Lagrange's polynomials.
Point point_at(unsigned corners, unsigned p, const std::vector<Coordinates<double>>& nodes, double s, double t) {
    const std::span<const LatticePlace> lattice = lattice_of_cell(corners, p);
    Point sum{0, 0};
    for (std::size_t n = 0; n < lattice.size(); ++n) {
        const auto [i, j] = lattice[n];
        const unsigned k = p - i - j;
        const double weight =
            corners == 4 ? lagrange_on(p, p, i, s).f * lagrange_on(p, p, j, t).f
                         : lagrange_on(p, i, i, s).f * lagrange_on(p, j, j, t).f * lagrange_on(p, k, k, 1 - s - t).f;
        sum = sum + weight * Point{nodes[n].x, nodes[n].y};
    }
    return sum;
}

TEST(JacobianBounds, AreTheSameForNodesOfGaussAndLobatto) {
    constexpr NodeDistribution lobatto = NodeDistribution::gauss_lobatto;
    core::Random random(5);
    std::size_t valid = 0, invalid = 0;
    for (int round = 0; round < 300; ++round)
        for (const unsigned corners : every_shape)
            for (unsigned p = 1; p <= max_cell_order; ++p) {
                const auto nodes = random_cell(corners, p, random);
                std::vector<Point> moved;
                for (const auto [s, t] : places_of_nodes(corners, p, lobatto))
                    moved.push_back(point_at(corners, p, nodes, s, t));
                const JacobianBounds expected = bound_jacobian(corners, p, points_of(nodes)),
                                     bounds = bound_jacobian(corners, p, moved, lobatto);
                const double rounding = 0x1p-19 * expected.upper;  // cells that are all but straight have such bounds
                if (expected.verdict != CellVerdict::unproved) {
                    EXPECT_EQ(bounds.verdict, expected.verdict);
                }
                EXPECT_NEAR(bounds.upper, expected.upper, rounding);
                if (expected.verdict != CellVerdict::valid) {
                    invalid += expected.verdict == CellVerdict::invalid;
                    continue;
                }
                ++valid;
                EXPECT_NEAR(bounds.lower, expected.lower, rounding);
            }
    EXPECT_GT(valid, 500u);
    EXPECT_GT(invalid, 100u);
}

TEST(DeterminantRules, KnowLagrangesPolynomialsOfBothDistributions) {
    for (const NodeDistribution distribution : {NodeDistribution::equidistant, NodeDistribution::gauss_lobatto})
        for (unsigned p = 1; p <= max_cell_order; ++p) {
            const std::span<const NodePlace> places = places_of_nodes(3, p, distribution);
            for (std::size_t n = 0; n < places.size(); ++n) {
                const std::vector<double> at_node = lagrange_in_triangle(p, distribution, places[n].s, places[n].t);
                for (std::size_t m = 0; m < places.size(); ++m) EXPECT_NEAR(at_node[m], m == n ? 1 : 0, 4e-15);
            }
            double slope = 0;  // of Legendre's polynomial, which nodes within [0, 1] have as zeros of its derivative
            for (unsigned i = 1; i < p && p > 2 && distribution == NodeDistribution::gauss_lobatto; ++i) {
                const double x = 2 * place_on_edge(p, i, distribution) - 1;
                slope = std::max(slope, std::abs(p == 3 ? 7.5 * x * x - 1.5 : 17.5 * x * x * x - 7.5 * x));
            }
            EXPECT_LT(slope, 1e-14);
        }
}

/// Returns a cell with straight edges and evenly spaced nodes.
std::vector<Point> straight_cell(unsigned corners, unsigned p, const std::array<Point, 4>& v) {
    std::vector<Point> nodes;
    for (const auto [i, j] : lattice_of_cell(corners, p)) {
        const double s = static_cast<double>(i) / p, t = static_cast<double>(j) / p;
        nodes.push_back(corners == 3 ? (1 - s - t) * v[0] + s * v[1] + t * v[2]
                                     : (1 - t) * ((1 - s) * v[0] + s * v[1]) + t * ((1 - s) * v[3] + s * v[2]));
    }
    return nodes;
}

TEST(JacobianBounds, AreThoseOfTheCornersForStraightCells) {
    const std::array<Point, 4> corners_at{{{0.1, 0}, {1, 0.1}, {0.9, 1.3}, {-0.2, 0.8}}};
    const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
        return cross(corners_at[b] - corners_at[a], corners_at[c] - corners_at[a]);
    };
    for (unsigned p = 1; p <= max_cell_order; ++p) {
        const JacobianBounds triangle = bound_jacobian(3, p, straight_cell(3, p, corners_at));
        EXPECT_NEAR(triangle.lower, area(0, 1, 2), 1e-9);
        EXPECT_NEAR(triangle.upper, area(0, 1, 2), 1e-9);
        const JacobianBounds quad = bound_jacobian(4, p, straight_cell(4, p, corners_at));
        const std::array<double, 4> areas{area(3, 0, 1), area(0, 1, 2), area(1, 2, 3), area(2, 3, 0)};
        EXPECT_NEAR(quad.lower, *std::min_element(areas.begin(), areas.end()), 1e-9);
        EXPECT_NEAR(quad.upper, *std::max_element(areas.begin(), areas.end()), 1e-9);
    }
}

/// Returns the nodes of a quadrilateral, each corner named after the one before: it is the same cell.
std::vector<Point> turned_quad(unsigned p, const std::vector<Point>& nodes) {
    const std::span<const LatticePlace> lattice = lattice_of_cell(4, p);
    std::vector<Point> turned;
    for (const LatticePlace& place : lattice) {
        const auto from = std::find_if(lattice.begin(), lattice.end(), [&](const LatticePlace& other) {
            return other.i == place.j && other.j == p - place.i;
        });
        turned.push_back(nodes[static_cast<std::size_t>(from - lattice.begin())]);
    }
    return turned;
}

TEST(JacobianBounds, OfCellsLinearInOneDirectionAreThoseOfAllCoefficients) {
    // Two curves with straight lines from one to the other, as in the columns of a layer. Turned by a corner, the cell
    // is linear along the edges whose curves are not looked at alone.
    core::Random random(11);
    std::size_t valid = 0, otherwise = 0;
    for (int round = 0; round < 300; ++round)
        for (unsigned p = 2; p <= max_cell_order; ++p) {
            const double height = std::pow(10, random.real(-5, 0)), angle = random.real(0, 7),
                         bend = random.real(0, 0.5);
            const double grown = random.real(0.5, 1.5), lean = random.real(-0.3, 0.3);
            const double c = std::cos(angle), s = std::sin(angle);
            std::array<double, max_cell_order + 1> off{};
            for (unsigned k = 1; k < p; ++k) off[k] = bend * random.real(-1, 1) / p;
            std::vector<Point> nodes;
            for (const auto [i, j] : lattice_of_cell(4, p)) {
                // From the wall at i = 0 on, as fill.cpp lists corners: up, along, down.
                const double up = static_cast<double>(i) / p, along = static_cast<double>(j) / p;
                const double share = 1 - 0.3 * up * (1 - along + grown * along);
                const double x = -along + lean * height * up,
                             y = height * up * (1 - along + grown * along) + share * off[j];
                nodes.push_back({3 + c * x - s * y, 2 + s * x + c * y});
            }
            const JacobianBounds linear = bound_jacobian(4, p, nodes),
                                 full = bound_jacobian(4, p, turned_quad(p, nodes));
            ASSERT_EQ(linear.verdict, full.verdict);
            if (full.verdict != CellVerdict::valid) continue;
            ++valid;
            otherwise += linear.lower != full.lower;
            EXPECT_NEAR(linear.lower, full.lower, 1e-6 * full.lower);
            EXPECT_NEAR(linear.upper, full.upper, 1e-6 * full.upper);
            std::vector<Coordinates<double>> places;
            for (const Point at : nodes) places.push_back({at.x, at.y});
            sample_determinant(4, p, places, 12, [&](double value) {
                EXPECT_GE(value, linear.lower * (1 - 1e-9) - 1e-14);
                EXPECT_LE(value, linear.upper * (1 + 1e-9) + 1e-14);
            });
        }
    EXPECT_GT(valid, 400u);
    EXPECT_GT(otherwise, 400u);  // another route, which rounds in another way
}

TEST(JacobianBounds, KnowInvalidCells) {
    for (const unsigned corners : every_shape)
        for (unsigned p = 1; p <= max_cell_order; ++p) {
            const std::array<Point, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
            std::vector<Point> mirrored = straight_cell(corners, p, square);
            for (Point& node : mirrored) node.x = -node.x;
            EXPECT_EQ(bound_jacobian(corners, p, mirrored).verdict, CellVerdict::invalid);
            const std::vector<Point> flat(nodes_of_cell(corners, p), Point{1, 2});
            EXPECT_EQ(bound_jacobian(corners, p, flat).verdict, CellVerdict::unproved);
            if (p == 1) continue;
            // A node of the first edge, moved through the cell until the map folds there.
            std::vector<Point> folded = straight_cell(corners, p, square);
            folded[corners].y += 0.9;
            EXPECT_EQ(bound_jacobian(corners, p, folded).verdict, CellVerdict::invalid) << corners << ' ' << p;
        }
    // The determinant of this parabola's sector vanishes at one corner and is positive elsewhere: 1 - 4 x 1/4.
    std::vector<Point> touching = straight_cell(3, 2, {{{0, 0}, {1, 0}, {0, 1}, {}}});
    touching[3].y = 0.25;
    touching[5] = {0, 0.5};
    EXPECT_EQ(bound_jacobian(3, 2, touching).verdict, CellVerdict::unproved);
    touching[3].y = 0.2499;
    EXPECT_EQ(bound_jacobian(3, 2, touching).verdict, CellVerdict::valid);
    touching[3].y = 0.2501;
    EXPECT_EQ(bound_jacobian(3, 2, touching).verdict, CellVerdict::invalid);
}

TEST(JacobianBounds, ProveNothingWhereNumbersOverflow) {
    const double large = 2.4937938687092768e154;  // whose square is finite, and twice that is not
    const std::vector<Point> overflowing{{0, 0}, {1, 0}, {0, 1}, {large, large}, {0, 0}, {-large, large}};
    EXPECT_EQ(bound_jacobian(3, 2, overflowing).verdict, CellVerdict::unproved);
    const std::array<Point, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (const unsigned corners : every_shape)
        for (unsigned p = 1; p <= max_cell_order; ++p)
            for (const double size : {1e100, 1e150, 1e153, 1e154, 1e155, 1e200, 1e308})
                for (const double sign : {1.0, -1.0}) {
                    std::vector<Point> nodes = straight_cell(corners, p, square);
                    for (Point& node : nodes) node = {sign * size * node.x, size * node.y};
                    const JacobianBounds bounds = bound_jacobian(corners, p, nodes);
                    EXPECT_NE(bounds.verdict, sign > 0 ? CellVerdict::invalid : CellVerdict::valid);
                    EXPECT_LE(bounds.scaled(), 1);
                    EXPECT_GE(bounds.scaled(), 0);
                }
}

/// Expects the places of the nodes to be those of these pairs of digits.
void expect_lattice(unsigned corners, unsigned order, const std::string& digits) {
    std::string found;
    for (const auto [i, j] : lattice_of_cell(corners, order))
        found += (found.empty() ? "" : " ") + std::to_string(i) + std::to_string(j);
    EXPECT_EQ(found, digits);
}

TEST(CellLattice, HasTheOrderOfGmsh) {
    expect_lattice(3, 2, "00 20 02 10 11 01");
    expect_lattice(4, 2, "00 20 22 02 10 21 12 01 11");
    expect_lattice(3, 3, "00 30 03 10 20 21 12 02 01 11");
    expect_lattice(4, 3, "00 30 33 03 10 20 31 32 23 13 02 01 11 21 22 12");
    expect_lattice(3, 4, "00 40 04 10 20 30 31 22 13 03 02 01 11 21 12");
    expect_lattice(4, 4, "00 40 44 04 10 20 30 41 42 43 34 24 14 03 02 01 11 31 33 13 21 32 23 12 22");
}

TEST(JacobianBounds, DoNotDependOnTheFirstCornerOrThePlace) {
    core::Random random(3);
    for (int round = 0; round < 100; ++round)
        for (const unsigned corners : every_shape) {
            const unsigned p = 2 + static_cast<unsigned>(random.below(3));
            const std::vector<Point> nodes = points_of(random_cell(corners, p, random));
            const JacobianBounds bounds = bound_jacobian(corners, p, nodes);
            std::vector<Point> moved, turned(nodes.size());
            for (const Point node : nodes) moved.push_back({-node.y, node.x});
            const std::span<const LatticePlace> lattice = lattice_of_cell(corners, p);
            for (std::size_t n = 0; n < nodes.size(); ++n) {
                const auto [i, j] = lattice[n];
                const LatticePlace next = corners == 3 ? LatticePlace{p - i - j, i} : LatticePlace{p - j, i};
                const auto at = std::find_if(lattice.begin(), lattice.end(), [&](const LatticePlace& place) {
                    return place.i == next.i && place.j == next.j;
                });
                turned[static_cast<std::size_t>(at - lattice.begin())] = nodes[n];
            }
            for (const std::vector<Point>& other : {moved, turned}) {
                const JacobianBounds same = bound_jacobian(corners, p, other);
                EXPECT_EQ(same.verdict, bounds.verdict);
                EXPECT_NEAR(same.upper, bounds.upper, 1e-9);
            }
        }
}

}  // namespace
}  // namespace lamina::mesh
