#include "mesh/determinant_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "mesh/cell_lattice.hpp"

namespace lamina::mesh {

namespace {

double factorial(unsigned n) { return n < 2 ? 1 : n * factorial(n - 1); }
double binomial(unsigned n, unsigned k) { return factorial(n) / (factorial(k) * factorial(n - k)); }

/// A homogeneous polynomial in three variables of degree d: the coefficient of x^i y^j z^(d-i-j) at [i][j].
using Homogeneous = std::array<std::array<double, max_cell_order + 1>, max_cell_order + 1>;

/// Returns a polynomial of degree d times (a x + b y + c z).
Homogeneous times_linear(const Homogeneous& f, unsigned d, double a, double b, double c) {
    Homogeneous product{};
    for (unsigned i = 0; i <= d; ++i)
        for (unsigned j = 0; i + j <= d; ++j) {
            if (i + 1 <= max_cell_order) product[i + 1][j] += a * f[i][j];
            if (j + 1 <= max_cell_order) product[i][j + 1] += b * f[i][j];
            product[i][j] += c * f[i][j];
        }
    return product;
}

/// Returns i! j! k! times Lagrange's polynomial of the node (i, j) of a triangle, in barycentric coordinates, which is
/// a product of linear factors (p x - r (x + y + z)) and has whole coefficients.
Homogeneous lagrange_polynomial(unsigned p, unsigned i, unsigned j) {
    Homogeneous f{};
    f[0][0] = 1;
    unsigned degree = 0;
    const std::array<unsigned, 3> exponents{i, j, p - i - j};
    for (std::size_t v = 0; v < 3; ++v)
        for (unsigned r = 0; r < exponents[v]; ++r) {
            const auto factor = [&](std::size_t w) { return static_cast<double>(w == v ? p : 0) - r; };
            f = times_linear(f, degree++, factor(0), factor(1), factor(2));
        }
    return f;
}

/// Calls f(a, b, factor) for all coefficients of a triangle: the factor, a whole number, of the node (i, j) in (p!)^2
/// times the Bernstein coefficient (a, b).
template <class F>
void for_each_triangle_factor(unsigned p, const LatticePlace& node, F&& f) {
    const Homogeneous polynomial = lagrange_polynomial(p, node.i, node.j);
    const double of_node = factorial(p) / (factorial(node.i) * factorial(node.j) * factorial(p - node.i - node.j));
    for (unsigned a = 0; a <= p; ++a)
        for (unsigned b = 0; a + b <= p; ++b)
            f(a, b, polynomial[a][b] * factorial(a) * factorial(b) * factorial(p - a - b) * of_node);
}

/// Numbers with at least 11 more bits than double has, where the machine has them.
using Precise = long double;
using PreciseRows = std::vector<std::vector<Precise>>;  ///< [coefficient][node]

/// What is off in the factors below once they are rounded, all of one coefficient together, over their sum. They come
/// of some 50 operations on numbers that are not small.
constexpr double error_of_rounded_factors = std::numeric_limits<Precise>::digits >= 64 ? 0x1p-49 : 0x1p-45;

/// Returns x_i of Gauss and Lobatto's nodes, as place_on_edge() does.
Precise precise_place(unsigned p, unsigned i) {
    if (i == 0 || i == p || 2 * i == p) return static_cast<Precise>(i) / p;
    const Precise first = 0.5L * (1 - std::sqrt(p == 3 ? 0.2L : 3.0L / 7));
    return i == 1 ? first : 1 - first;
}

/// Returns the Bernstein coefficients of Lagrange's polynomials of Gauss and Lobatto's nodes on a segment: products of
/// linear factors (x - x_k) / (x_n - x_k), each of which raises the degree.
PreciseRows lobatto_rows_of_curve(unsigned p) {
    PreciseRows rows(p + 1, std::vector<Precise>(p + 1));
    for (unsigned node = 0; node <= p; ++node) {
        std::vector<Precise> f{1};
        for (unsigned k = 0; k <= p; ++k) {
            if (k == node) continue;
            const auto degree = static_cast<unsigned>(f.size());
            const Precise x = precise_place(p, k), width = precise_place(p, node) - x;
            std::vector<Precise> product(degree + 1);
            for (unsigned a = 0; a <= degree; ++a) {
                if (a < degree) product[a] += static_cast<Precise>(degree - a) / degree * f[a] * (-x / width);
                if (a > 0) product[a] += static_cast<Precise>(a) / degree * f[a - 1] * ((1 - x) / width);
            }
            f = product;
        }
        for (unsigned a = 0; a <= p; ++a) rows[a][node] = f[a];
    }
    return rows;
}

/// Returns the exponent of the barycentric coordinate of a corner in the coefficient, or at the node, of a place.
unsigned exponent_of(const LatticePlace& place, unsigned p, unsigned corner) {
    return corner == 0 ? p - place.i - place.j : corner == 1 ? place.i : place.j;
}

/// Returns the Bernstein coefficients, in the order of a grid, of Lagrange's polynomials of Gauss and Lobatto's nodes
/// on the border of a triangle: on each edge those of a segment.
PreciseRows lobatto_rows_of_border(unsigned p, const CoefficientGrid& map) {
    const PreciseRows of_curve = lobatto_rows_of_curve(p);
    const std::span<const LatticePlace> lattice = lattice_of_cell(3, p);
    PreciseRows rows(map.size(), std::vector<Precise>(lattice.size()));
    const auto set_edge = [&](const LatticePlace& coefficient, unsigned corner) {
        const unsigned along = (corner + 1) % 3;
        for (std::size_t n = 0; n < lattice.size(); ++n)
            if (exponent_of(lattice[n], p, corner) == 0)
                rows[map.at(coefficient.i, coefficient.j)][n] =
                    of_curve[exponent_of(coefficient, p, along)][exponent_of(lattice[n], p, along)];
    };
    for (const LatticePlace& coefficient : lattice)
        for (unsigned corner = 0; corner < 3; ++corner)
            if (exponent_of(coefficient, p, corner) == 0) set_edge(coefficient, corner);
    return rows;
}

/// Returns a Bernstein polynomial at a place in barycentric coordinates.
template <class Number>
Number bernstein_at(const LatticePlace& coefficient, unsigned p, const std::array<Number, 3>& place) {
    Number value = factorial(p);
    for (unsigned corner = 0; corner < 3; ++corner)
        for (unsigned k = 1; k <= exponent_of(coefficient, p, corner); ++k) value *= place[corner] / k;
    return value;
}

/// Adds a multiple of a row to another one.
void add_multiple(Precise factor, const std::vector<Precise>& row, std::vector<Precise>& to) {
    for (std::size_t n = 0; n < to.size(); ++n) to[n] += factor * row[n];
}

/// Returns the coefficients of all nodes of a triangle. Within it are as many coefficients as nodes, one or three, of
/// which each belongs to the node of the same exponents: with a for the smaller barycentric coordinates of a node of
/// order 4 and b = 1 - 2 a for the largest one, their values at the nodes are 12 a^2 b (a J + (b - a) I), where all of
/// J is 1, and the inverse of that is (I - a J) / (12 a^2 b (b - a)).
PreciseRows lobatto_rows_of_triangle(unsigned p, const CoefficientGrid& map) {
    PreciseRows rows = lobatto_rows_of_border(p, map);
    const std::span<const LatticePlace> lattice = lattice_of_cell(3, p);
    const std::size_t border = std::size_t{3} * p, within = lattice.size() - border;
    const Precise x1 = precise_place(p, 1), a = p == 3 ? Precise{1} / 3 : x1 / (2 * x1 + precise_place(p, 2)),
                  b = 1 - 2 * a, size = p == 3 ? 2.0L / 9 : 12 * a * a * b * (b - a);
    // What is left of each polynomial at the nodes within once the border's part is taken off.
    PreciseRows rest(within, std::vector<Precise>(lattice.size()));
    for (std::size_t m = 0; m < within; ++m) {
        rest[m][border + m] = 1;
        std::array<Precise, 3> place{};
        for (unsigned corner = 0; corner < 3; ++corner)
            place[corner] = exponent_of(lattice[border + m], p, corner) == 1 ? a : b;
        for (const LatticePlace& coefficient : lattice.first(border)) {
            const Precise value = bernstein_at(coefficient, p, place);
            const std::vector<Precise>& row = rows[map.at(coefficient.i, coefficient.j)];
            add_multiple(-value, row, rest[m]);
        }
    }
    for (std::size_t c = 0; c < within; ++c) {
        std::vector<Precise>& row = rows[map.at(lattice[border + c].i, lattice[border + c].j)];
        for (std::size_t m = 0; m < within; ++m) {
            const Precise factor = p == 3 ? 1 / size : ((c == m ? 1 : 0) - a) / size;
            add_multiple(factor, rest[m], row);
        }
    }
    return rows;
}

/// On an edge of the triangle its polynomials are those of a segment.
CurveRule make_curve_rule(unsigned p, NodeDistribution distribution) {
    CurveRule rule;
    if (distribution == NodeDistribution::gauss_lobatto) {
        const PreciseRows rows = lobatto_rows_of_curve(p);
        for (unsigned a = 0; a <= p; ++a)
            for (unsigned node = 0; node <= p; ++node) rule.to_bernstein[a][node] = static_cast<double>(rows[a][node]);
    } else {
        rule.factor = std::pow(factorial(p), 2);
        for (unsigned node = 0; node <= p; ++node)
            for_each_triangle_factor(p, {node, p - node}, [&](unsigned a, unsigned b, double factor) {
                if (a + b == p) rule.to_bernstein[a][node] = factor;
            });
    }
    for (unsigned a = 0; a <= p; ++a) {
        double sum = 0;
        for (unsigned node = 0; node <= p; ++node) sum += std::abs(rule.to_bernstein[a][node]);
        rule.largest_row = std::max(rule.largest_row, sum);
        rule.weights[a] = binomial(p, a);
        if (a < p) rule.weights_of_derivative[a] = binomial(p - 1, a);
    }
    for (unsigned k = 0; k < 2 * p; ++k) rule.weights_of_product[k] = binomial(2 * p - 1, k);
    return rule;
}

/// Puts lists one behind the other, and says where each begins, and the last one ends.
template <class T>
void join_lists(const std::vector<std::vector<T>>& lists, std::vector<T>& joined, std::vector<std::size_t>& first) {
    first = {0};
    for (const std::vector<T>& list : lists) {
        joined.insert(joined.end(), list.begin(), list.end());
        first.push_back(joined.size());
    }
}

/// Adds how nodes become the coefficients of the map, those of evenly spaced ones on a square times (p!)^4.
void add_conversion(unsigned corners, unsigned p, const CoefficientGrid& map, DeterminantRule& rule) {
    const std::span<const LatticePlace> lattice = lattice_of_cell(corners, p);
    rule.nodes = lattice.size();
    rule.curve = make_curve_rule(p, rule.distribution);
    const bool is_lobatto = rule.distribution == NodeDistribution::gauss_lobatto;
    const PreciseRows lobatto = is_lobatto && corners == 3 ? lobatto_rows_of_triangle(p, map) : PreciseRows{};
    std::vector<std::vector<NodeFactor>> of_coefficients(map.size());
    std::vector<double> sums(map.size());
    for (std::size_t node = 0; node < rule.nodes; ++node) {
        const LatticePlace& place = lattice[node];
        const auto add = [&](unsigned a, unsigned b, double factor) {
            if (factor != 0) of_coefficients[map.at(a, b)].push_back({node, factor});
            sums[map.at(a, b)] += std::abs(factor);
        };
        if (corners == 3 && is_lobatto)
            map.for_each([&](unsigned a, unsigned b) { add(a, b, static_cast<double>(lobatto[map.at(a, b)][node])); });
        else if (corners == 3)
            for_each_triangle_factor(p, place, add);
        else
            map.for_each([&](unsigned a, unsigned b) {
                add(a, b, rule.curve.to_bernstein[a][place.i] * rule.curve.to_bernstein[b][place.j]);
            });
    }
    rule.largest_row = *std::max_element(sums.begin(), sums.end());
    join_lists(of_coefficients, rule.to_bernstein, rule.first_factor);
}

/// Adds the derivatives along i and j and what their products amount to. A derivative on the square is of lower degree
/// in its own direction alone, and on the triangle of lower total degree.
void add_products(const CoefficientGrid& map, const CoefficientGrid& along, const CoefficientGrid& across,
                  DeterminantRule& rule) {
    rule.along.resize(along.size());
    rule.across.resize(across.size());
    along.for_each([&](unsigned i, unsigned j) {
        rule.along[along.at(i, j)] = {map.at(i + 1, j), map.at(i, j), along.weight(i, j)};
    });
    across.for_each([&](unsigned i, unsigned j) {
        rule.across[across.at(i, j)] = {map.at(i, j + 1), map.at(i, j), across.weight(i, j)};
    });
    std::vector<std::vector<ProductTerm>> of_coefficients(rule.grid.size());
    along.for_each([&](unsigned i, unsigned j) {
        across.for_each([&](unsigned k, unsigned l) {
            std::vector<ProductTerm>& terms = of_coefficients[rule.grid.at(i + k, j + l)];
            terms.push_back({static_cast<std::uint32_t>(along.at(i, j)), static_cast<std::uint32_t>(across.at(k, l))});
            rule.terms_of_one = std::max(rule.terms_of_one, terms.size());
        });
    });
    join_lists(of_coefficients, rule.terms, rule.first_term);
    rule.weights.resize(rule.grid.size());
    rule.grid.for_each([&](unsigned i, unsigned j) { rule.weights[rule.grid.at(i, j)] = rule.grid.weight(i, j); });
}

DeterminantRule make_rule(unsigned corners, unsigned p, NodeDistribution distribution) {
    const CoefficientGrid map{corners, p, p};
    const bool is_triangle = corners == 3;
    const unsigned degree = is_triangle ? 2 * (p - 1) : 2 * p - 1;
    DeterminantRule rule;
    rule.grid = {corners, degree, degree};
    rule.order = p;
    // Up to order 2 all nodes are evenly spaced.
    if (p > 2) rule.distribution = distribution;
    if (rule.distribution == NodeDistribution::gauss_lobatto) rule.error_of_factors = error_of_rounded_factors;
    add_conversion(corners, p, map, rule);
    add_products(map, {corners, p - 1, p}, {corners, is_triangle ? p - 1 : p, p - 1}, rule);
    const double factor = is_triangle ? rule.curve.factor : std::pow(rule.curve.factor, 2);
    rule.scale = (p / factor) * (p / factor);
    rule.slope_of_bend = 2 * p * rule.largest_row / factor;
    rule.corners = {rule.grid.at(0, 0), rule.grid.at(degree, 0), rule.grid.at(0, degree)};
    if (!is_triangle) rule.corners.push_back(rule.grid.at(degree, degree));
    return rule;
}

using RulesByOrder = std::array<DeterminantRule, max_cell_order + 1>;

RulesByOrder make_rules(unsigned corners, NodeDistribution distribution) {
    RulesByOrder rules;
    for (unsigned p = 1; p <= max_cell_order; ++p) rules[p] = make_rule(corners, p, distribution);
    return rules;
}

}  // namespace

double CoefficientGrid::weight(unsigned i, unsigned j) const {
    if (corners == 4) return binomial(n, i) * binomial(m, j);
    return factorial(n) / (factorial(i) * factorial(j) * factorial(n - i - j));
}

const DeterminantRule& determinant_rule(unsigned corners, unsigned order, NodeDistribution distribution) {
    static const std::array<std::array<RulesByOrder, 2>, 2> rules{
        {{make_rules(3, NodeDistribution::equidistant), make_rules(4, NodeDistribution::equidistant)},
         {make_rules(3, NodeDistribution::gauss_lobatto), make_rules(4, NodeDistribution::gauss_lobatto)}}};
    return rules[static_cast<std::size_t>(distribution)][corners - 3][order];
}

std::vector<double> lagrange_in_triangle(unsigned order, NodeDistribution distribution, double s, double t) {
    const DeterminantRule& rule = determinant_rule(3, order, distribution);
    const CoefficientGrid map{3, order, order};
    std::vector<double> values(rule.nodes);
    map.for_each([&](unsigned i, unsigned j) {
        const double bernstein = bernstein_at<double>({i, j}, order, {1 - s - t, s, t}) / rule.curve.factor;
        const std::size_t c = map.at(i, j);
        for (std::size_t k = rule.first_factor[c]; k < rule.first_factor[c + 1]; ++k)
            values[rule.to_bernstein[k].node] += bernstein * rule.to_bernstein[k].value;
    });
    return values;
}

}  // namespace lamina::mesh
