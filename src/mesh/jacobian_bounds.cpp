// Source: A. Johnen, J.-F. Remacle, C. Geuzaine, J. Comput. Phys. 233 (2013); subdivision and products of polynomials in
// Bernstein's form: G. Farin, Curves and Surfaces for CAGD (2002), chapters 5 and 17; bounds of rounding errors: N. J.
// Higham, Accuracy and Stability of Numerical Algorithms (2002), chapter 3.
#include "mesh/jacobian_bounds.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/cell_lattice.hpp"

namespace lamina::mesh {

namespace {

constexpr int max_halvings = 2 * 12;  // in two directions by turns
constexpr double rounding_unit = 0x1p-53;

double factorial(unsigned n) { return n < 2 ? 1 : n * factorial(n - 1); }
double binomial(unsigned n, unsigned k) { return factorial(n) / (factorial(k) * factorial(n - k)); }

// ---- coefficients in one array -------------------------------------------------------------------------------------

/// The coefficients of polynomials on a cell: of degree (n, m) on the square, at [i m' + j] with m' = m + 1, and of total
/// degree n on the triangle, at the place of (i, j) in rows of ascending j, where the third exponent is n - i - j.
struct CoefficientGrid {
    unsigned corners, n, m;

    std::size_t size() const { return corners == 3 ? std::size_t{n + 1} * (n + 2) / 2 : std::size_t{n + 1} * (m + 1); }
    std::size_t at(unsigned i, unsigned j) const {
        if (corners == 4) return std::size_t{i} * (m + 1) + j;
        return std::size_t{j} * (2 * n + 3 - j) / 2 + i;
    }
    /// Calls f(i, j) for all coefficients.
    template <class F>
    void for_each(F&& f) const {
        for (unsigned i = 0; i <= n; ++i)
            for (unsigned j = 0; j <= (corners == 3 ? n - i : m); ++j) f(i, j);
    }
    /// Returns the number of ways to choose so much of so much that weighs the coefficient (i, j).
    double weight(unsigned i, unsigned j) const {
        if (corners == 4) return binomial(n, i) * binomial(m, j);
        return factorial(n) / (factorial(i) * factorial(j) * factorial(n - i - j));
    }
};

// ---- rules, which depend on shape and order alone -------------------------------------------------------------------

/// The difference of two Bernstein coefficients of the map, one of its derivative.
struct Difference {
    std::size_t plus, minus;
};

/// The part of a coefficient of the determinant that two derivatives have.
struct ProductTerm {
    std::size_t coefficient, along, across;  ///< `along` and `across` are places in the lists of derivatives
    double weight;
};

/// How nodes become the coefficients of the determinant, but for the factor `scale`.
struct DeterminantRule {
    CoefficientGrid grid;  ///< of the determinant
    std::size_t nodes = 0;
    std::vector<double> to_bernstein;  ///< whole numbers: per node, its factors in all coefficients of the map
    double largest_row = 0;            ///< largest sum of the sizes of the factors of a coefficient
    std::vector<Difference> along, across;
    std::vector<ProductTerm> terms;
    std::size_t terms_of_one = 0;      ///< largest number of terms of one coefficient
    double scale = 1;                  ///< the determinant over what the terms amount to
    std::vector<std::size_t> corners;  ///< the coefficients that are values at the corners
};

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

/// Returns i! j! k! times Lagrange's polynomial of the node (i, j) of a triangle, in barycentric coordinates, which is a
/// product of linear factors (p x - r (x + y + z)) and has whole coefficients.
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

/// Returns the factor, a whole number, of the node (i, j) of a triangle in (p!)^2 times the Bernstein coefficient (a, b).
double triangle_factor(unsigned p, const LatticePlace& node, unsigned a, unsigned b) {
    const unsigned c = p - a - b, k = p - node.i - node.j;
    return lagrange_polynomial(p, node.i, node.j)[a][b] * factorial(a) * factorial(b) * factorial(c) *
           (factorial(p) / (factorial(node.i) * factorial(node.j) * factorial(k)));
}

/// Returns the factor of a node of a square in (p!)^4 times the Bernstein coefficient (a, b). On an edge of the triangle
/// its polynomials are those of a segment.
double square_factor(unsigned p, const LatticePlace& node, unsigned a, unsigned b) {
    return triangle_factor(p, {node.i, p - node.i}, a, p - a) * triangle_factor(p, {node.j, p - node.j}, b, p - b);
}

void add_conversion(unsigned corners, unsigned p, const CoefficientGrid& map, DeterminantRule& rule) {
    const std::span<const LatticePlace> lattice = lattice_of_cell(corners, p);
    rule.nodes = lattice.size();
    rule.to_bernstein.resize(map.size() * rule.nodes);
    map.for_each([&](unsigned a, unsigned b) {
        double sum = 0;
        for (std::size_t node = 0; node < rule.nodes; ++node) {
            const double factor =
                corners == 3 ? triangle_factor(p, lattice[node], a, b) : square_factor(p, lattice[node], a, b);
            rule.to_bernstein[node * rule.nodes + map.at(a, b)] = factor;
            sum += std::abs(factor);
        }
        rule.largest_row = std::max(rule.largest_row, sum);
    });
}

/// Adds the derivatives along i and j and what their products amount to. A derivative on the square is of lower degree in
/// its own direction alone, and on the triangle of lower total degree.
void add_products(const CoefficientGrid& map, const CoefficientGrid& along, const CoefficientGrid& across,
                  DeterminantRule& rule) {
    rule.along.resize(along.size());
    rule.across.resize(across.size());
    along.for_each([&](unsigned i, unsigned j) { rule.along[along.at(i, j)] = {map.at(i + 1, j), map.at(i, j)}; });
    across.for_each([&](unsigned i, unsigned j) { rule.across[across.at(i, j)] = {map.at(i, j + 1), map.at(i, j)}; });
    along.for_each([&](unsigned i, unsigned j) {
        across.for_each([&](unsigned k, unsigned l) {
            rule.terms.push_back({rule.grid.at(i + k, j + l), along.at(i, j), across.at(k, l),
                                  along.weight(i, j) * across.weight(k, l) / rule.grid.weight(i + k, j + l)});
        });
    });
    std::vector<std::size_t> counts(rule.grid.size());
    for (const ProductTerm& term : rule.terms)
        rule.terms_of_one = std::max(rule.terms_of_one, ++counts[term.coefficient]);
}

DeterminantRule make_rule(unsigned corners, unsigned p) {
    const CoefficientGrid map{corners, p, p};
    const bool is_triangle = corners == 3;
    const unsigned degree = is_triangle ? 2 * (p - 1) : 2 * p - 1;
    DeterminantRule rule;
    rule.grid = {corners, degree, degree};
    add_conversion(corners, p, map, rule);
    add_products(map, {corners, p - 1, p}, {corners, is_triangle ? p - 1 : p, p - 1}, rule);
    const double factor = std::pow(factorial(p), is_triangle ? 2 : 4);
    rule.scale = (p / factor) * (p / factor);
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

const DeterminantRule& rule_of(unsigned corners, unsigned order) {
    static const RulesByOrder triangles = make_rules(3), squares = make_rules(4);
    return (corners == 3 ? triangles : squares)[order];
}

// ---- coefficients of one cell ----------------------------------------------------------------------------------------

/// Coefficients of the determinant: as many as quadrilaterals of the highest order have; others leave some unused.
using Coefficients = std::array<double, std::size_t{4} * max_cell_order * max_cell_order>;

/// Coefficients of the determinant on a part of the cell, each of which is within `radius` of the exact one.
struct Part {
    Coefficients coefficients{};
    double radius = 0;
    int halvings = 0;
};

/// The largest sizes of numbers and of their errors.
struct Magnitude {
    double size = 0, error = 0;
};

/// The derivatives of one coordinate, but for a factor, and how large they are.
struct Derivatives {
    std::array<double, std::size_t{max_cell_order + 1} * max_cell_order> along{}, across{};
    Magnitude largest;
};

/// Coordinates count from the first node on, which makes them small.
template <class Coordinate>
Derivatives derivatives_of(const DeterminantRule& rule, std::span<const Point> nodes, Coordinate coordinate) {
    const std::size_t n = rule.nodes;
    std::array<double, nodes_of_cell(4, max_cell_order)> local{}, map{};
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        local[i] = coordinate(nodes[i]) - coordinate(nodes[0]);
        largest = std::max(largest, std::abs(local[i]));
    }
    // Node by node, so that the coefficients are sums side by side.
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t a = 0; a < n; ++a) map[a] += rule.to_bernstein[i * n + a] * local[i];
    Derivatives result;
    const auto add = [&](const std::vector<Difference>& differences, auto& values) {
        for (std::size_t i = 0; i < differences.size(); ++i) {
            values[i] = map[differences[i].plus] - map[differences[i].minus];
            result.largest.size = std::max(result.largest.size, std::abs(values[i]));
        }
    };
    add(rule.along, result.along);
    add(rule.across, result.across);
    // Each of n products and sums rounds, and so has the local coordinate (Higham, section 3.1).
    const double of_map = (static_cast<double>(n) + 2) * rounding_unit * rule.largest_row * largest;
    result.largest.error = 2 * of_map + rounding_unit * result.largest.size;
    return result;
}

/// Bounds the errors of the sums of products x y' - x' y, whose weights amount to 1.
double radius_of(const DeterminantRule& rule, const Magnitude& x, const Magnitude& y) {
    constexpr double for_rounding_of_this = 1 + 0x1p-20, for_underflow = 1e-290;
    const double of_factors = 2 * (x.size * y.error + y.size * x.error + x.error * y.error);
    const double of_products = 2 * x.size * y.size;  // not finite where a product is not
    const double of_sums = of_products * (static_cast<double>(rule.terms_of_one) + 6) * rounding_unit;
    return for_rounding_of_this * (of_factors + of_sums) + for_underflow;
}

Part whole_cell(const DeterminantRule& rule, std::span<const Point> nodes) {
    const Derivatives x = derivatives_of(rule, nodes, [](Point p) { return p.x; });
    const Derivatives y = derivatives_of(rule, nodes, [](Point p) { return p.y; });
    Part part{{}, radius_of(rule, x.largest, y.largest), 0};
    for (const ProductTerm& t : rule.terms)
        part.coefficients[t.coefficient] +=
            t.weight * (x.along[t.along] * y.across[t.across] - y.along[t.along] * x.across[t.across]);
    return part;
}

// ---- halving ---------------------------------------------------------------------------------------------------------

/// Halves a polynomial in one variable by de Casteljau's algorithm. Its n + 1 coefficients are at places place(k); `first`
/// holds them, and those of the first half afterwards.
template <class Place>
void halve_row(unsigned n, Place place, Coefficients& first, Coefficients& second) {
    for (unsigned k = 0; k <= n; ++k) second[place(k)] = first[place(k)];
    for (unsigned level = 0; level <= n; ++level) {
        first[place(level)] = second[place(0)];
        for (unsigned k = 0; k + level < n; ++k) second[place(k)] = 0.5 * (second[place(k)] + second[place(k + 1)]);
    }
}

/// Exchanges i and j of the square, so that the next halving is in the other direction.
Coefficients turned_square(const CoefficientGrid& grid, const Coefficients& part) {
    Coefficients turned{};
    grid.for_each([&](unsigned i, unsigned j) { turned[grid.at(j, i)] = part[grid.at(i, j)]; });
    return turned;
}

/// Renames the corners of a triangle so that its newest one, the middle of the edge that was halved, is opposite to the
/// edge that is halved next (newest vertex bisection):
///
///         c                      c              The halves (a, m, c) and (m, b, c) become (c, a, m) and (b, c, m).
///        / \       first half   /|
///       /   \                  / |  next: the edge from c to a
///      a--m--b                a--m
///
/// Corner a has the exponent i, b has j, and c the rest.
Coefficients turned_triangle(const CoefficientGrid& grid, const Coefficients& part, bool is_first) {
    Coefficients turned{};
    grid.for_each([&](unsigned i, unsigned j) {
        const unsigned k = grid.n - i - j;
        turned[is_first ? grid.at(k, i) : grid.at(j, k)] = part[grid.at(i, j)];
    });
    return turned;
}

/// Halves a part: the square across i, and the triangle across the edge between its corners of exponents i and j.
std::pair<Part, Part> halves_of(const CoefficientGrid& grid, Part first) {
    double largest = 0;
    for (const double c : first.coefficients) largest = std::max(largest, std::abs(c));
    Part second = first;
    for (unsigned row = 0; row <= grid.m; ++row) {
        if (grid.corners == 4)
            halve_row(
                grid.n, [&](unsigned k) { return grid.at(k, row); }, first.coefficients, second.coefficients);
        else
            halve_row(
                grid.n - row, [&](unsigned k) { return grid.at(grid.n - row - k, k); }, first.coefficients,
                second.coefficients);
    }
    for (Part* half : {&first, &second}) {
        half->coefficients = grid.corners == 4 ? turned_square(grid, half->coefficients)
                                               : turned_triangle(grid, half->coefficients, half == &first);
        half->radius += (grid.n + 1) * rounding_unit * largest;  // each level of averages rounds
        ++half->halvings;
    }
    return {first, second};
}

/// Returns whether all coefficients and their errors are numbers whose sums do not overflow.
bool is_bounded(std::span<const double> coefficients, double radius) {
    constexpr double limit = 0x1p1022;
    return radius < limit && std::ranges::all_of(coefficients, [](double c) { return std::abs(c) < limit; });
}

}  // namespace

JacobianBounds bound_jacobian(unsigned corners, unsigned order, std::span<const Point> nodes) {
    assert(nodes.size() == nodes_of_cell(corners, order));
    const DeterminantRule& rule = rule_of(corners, order);
    const auto of_part = [&](const Part& part) { return std::span(part.coefficients).first(rule.grid.size()); };
    const auto largest_of = [&](const Part& part) { return *std::ranges::max_element(of_part(part)); };
    constexpr double for_rounding_of_scale = 0x1p-50;
    Part part = whole_cell(rule, nodes);
    if (!is_bounded(of_part(part), part.radius)) return {CellVerdict::unproved, 0, HUGE_VAL};
    const double upper = rule.scale * (largest_of(part) + part.radius);
    const JacobianBounds bounds{.upper = upper + for_rounding_of_scale * std::abs(upper)};
    std::vector<Part> undecided;
    double lower = HUGE_VAL;
    for (;;) {
        for (const std::size_t corner : rule.corners)
            if (part.coefficients[corner] < -part.radius) return {CellVerdict::invalid, 0, bounds.upper};
        const double smallest = *std::ranges::min_element(of_part(part)) - part.radius;
        if (smallest > 0) {
            lower = std::min(lower, smallest);
            if (undecided.empty()) break;
            part = undecided.back();
            undecided.pop_back();
            continue;
        }
        // What is not above its own error cannot be proved positive by any number of halvings.
        if (part.halvings == max_halvings || !(largest_of(part) > part.radius)) return bounds;
        const auto [first, second] = halves_of(rule.grid, part);
        undecided.push_back(first);
        part = second;
    }
    return {CellVerdict::valid, (1 - for_rounding_of_scale) * rule.scale * lower, bounds.upper};
}

}  // namespace lamina::mesh
