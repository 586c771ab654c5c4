#include "mesh/determinant_rule.hpp"

#include <algorithm>
#include <cmath>
#include <span>

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

/// On an edge of the triangle its polynomials are those of a segment.
CurveRule make_curve_rule(unsigned p) {
    CurveRule rule;
    for (unsigned node = 0; node <= p; ++node)
        for_each_triangle_factor(p, {node, p - node}, [&](unsigned a, unsigned b, double factor) {
            if (a + b == p) rule.to_bernstein[a][node] = factor;
        });
    for (unsigned a = 0; a <= p; ++a) {
        double sum = 0;
        for (unsigned node = 0; node <= p; ++node) sum += std::abs(rule.to_bernstein[a][node]);
        rule.largest_row = std::max(rule.largest_row, sum);
        rule.weights[a] = binomial(p, a);
        if (a < p) rule.weights_of_derivative[a] = binomial(p - 1, a);
    }
    for (unsigned k = 0; k < 2 * p; ++k) rule.weights_of_product[k] = binomial(2 * p - 1, k);
    rule.factor = std::pow(factorial(p), 2);
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

/// Adds how nodes become the coefficients of the map, those of a square times (p!)^4.
void add_conversion(unsigned corners, unsigned p, const CoefficientGrid& map, DeterminantRule& rule) {
    const std::span<const LatticePlace> lattice = lattice_of_cell(corners, p);
    rule.nodes = lattice.size();
    rule.curve = make_curve_rule(p);
    std::vector<std::vector<NodeFactor>> of_coefficients(map.size());
    std::vector<double> sums(map.size());
    for (std::size_t node = 0; node < rule.nodes; ++node) {
        const LatticePlace& place = lattice[node];
        const auto add = [&](unsigned a, unsigned b, double factor) {
            if (factor != 0) of_coefficients[map.at(a, b)].push_back({node, factor});
            sums[map.at(a, b)] += std::abs(factor);
        };
        if (corners == 3)
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

DeterminantRule make_rule(unsigned corners, unsigned p) {
    const CoefficientGrid map{corners, p, p};
    const bool is_triangle = corners == 3;
    const unsigned degree = is_triangle ? 2 * (p - 1) : 2 * p - 1;
    DeterminantRule rule;
    rule.grid = {corners, degree, degree};
    rule.order = p;
    add_conversion(corners, p, map, rule);
    add_products(map, {corners, p - 1, p}, {corners, is_triangle ? p - 1 : p, p - 1}, rule);
    const double factor = std::pow(factorial(p), is_triangle ? 2 : 4);
    rule.scale = (p / factor) * (p / factor);
    rule.slope_of_bend = 2 * p * rule.largest_row / factor;
    rule.corners = {rule.grid.at(0, 0), rule.grid.at(degree, 0), rule.grid.at(0, degree)};
    if (!is_triangle) rule.corners.push_back(rule.grid.at(degree, degree));
    return rule;
}

using RulesByOrder = std::array<DeterminantRule, max_cell_order + 1>;

RulesByOrder make_rules(unsigned corners) {
    RulesByOrder rules;
    for (unsigned p = 1; p <= max_cell_order; ++p) rules[p] = make_rule(corners, p);
    return rules;
}

}  // namespace

double CoefficientGrid::weight(unsigned i, unsigned j) const {
    if (corners == 4) return binomial(n, i) * binomial(m, j);
    return factorial(n) / (factorial(i) * factorial(j) * factorial(n - i - j));
}

const DeterminantRule& determinant_rule(unsigned corners, unsigned order) {
    static const RulesByOrder triangles = make_rules(3), squares = make_rules(4);
    return (corners == 3 ? triangles : squares)[order];
}

}  // namespace lamina::mesh
