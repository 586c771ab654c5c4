// Source: A. Johnen, J.-F. Remacle, C. Geuzaine, J. Comput. Phys. 233 (2013); subdivision and products of polynomials
// in Bernstein's form: G. Farin, Curves and Surfaces for CAGD (2002), chapters 5 and 17; bounds of rounding errors: N.
// J. Higham, Accuracy and Stability of Numerical Algorithms (2002), chapter 3.
#include "mesh/jacobian_bounds.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/cell_lattice.hpp"

namespace lamina::mesh {

namespace {

constexpr int max_halvings = 2 * 12;  // in two directions by turns
constexpr double rounding_unit = 0x1p-53, for_rounding_of_scale = 0x1p-50;
constexpr double largest_number = 0x1p1022;  // sums of a coefficient and its error do not overflow

double factorial(unsigned n) { return n < 2 ? 1 : n * factorial(n - 1); }
double binomial(unsigned n, unsigned k) { return factorial(n) / (factorial(k) * factorial(n - k)); }

// ---- coefficients in one array -------------------------------------------------------------------------------------

/// The coefficients of polynomials on a cell: of degree (n, m) on the square, at [i m' + j] with m' = m + 1, and of
/// total degree n on the triangle, at the place of (i, j) in rows of ascending j, where the third exponent is n - i -
/// j.
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
    double weight;  ///< of the coefficient in products
};

/// The part of a coefficient of the map that a node has.
struct NodeFactor {
    std::size_t node;
    double value;  ///< a whole number, not 0
};

/// The part of a coefficient of the determinant that two derivatives have.
struct ProductTerm {
    std::uint32_t along, across;  ///< places in the lists of derivatives
};

/// How nodes become the coefficients of the determinant, but for the factor `scale`.
struct DeterminantRule {
    CoefficientGrid grid;  ///< of the determinant
    unsigned order = 1;
    std::size_t nodes = 0;
    std::vector<NodeFactor> to_bernstein;   ///< coefficient by coefficient of the map
    std::vector<std::size_t> first_factor;  ///< of each coefficient of the map, then the end
    double largest_row = 0;                 ///< largest sum of the sizes of the factors of a coefficient
    std::vector<Difference> along, across;
    std::vector<ProductTerm> terms;       ///< coefficient by coefficient
    std::vector<std::size_t> first_term;  ///< of each coefficient of the determinant, then the end
    std::size_t terms_of_one = 0;         ///< largest number of terms of one coefficient
    std::vector<double> weights;          ///< of the coefficients, which are sums of products over their weight
    double slope_of_bend = 1;             ///< no derivative of a map with nodes up to 1 has larger coefficients
    double scale = 1;                     ///< the determinant over what the terms amount to
    std::vector<std::size_t> corners;     ///< the coefficients that are values at the corners
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

/// Returns the factor, a whole number, of the node (i, j) of a triangle in (p!)^2 times the Bernstein coefficient (a,
/// b).
double triangle_factor(unsigned p, const LatticePlace& node, unsigned a, unsigned b) {
    const unsigned c = p - a - b, k = p - node.i - node.j;
    return lagrange_polynomial(p, node.i, node.j)[a][b] * factorial(a) * factorial(b) * factorial(c) *
           (factorial(p) / (factorial(node.i) * factorial(node.j) * factorial(k)));
}

/// Returns the factor of a node of a square in (p!)^4 times the Bernstein coefficient (a, b). On an edge of the
/// triangle its polynomials are those of a segment.
double square_factor(unsigned p, const LatticePlace& node, unsigned a, unsigned b) {
    return triangle_factor(p, {node.i, p - node.i}, a, p - a) * triangle_factor(p, {node.j, p - node.j}, b, p - b);
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

void add_conversion(unsigned corners, unsigned p, const CoefficientGrid& map, DeterminantRule& rule) {
    const std::span<const LatticePlace> lattice = lattice_of_cell(corners, p);
    rule.nodes = lattice.size();
    std::vector<std::vector<NodeFactor>> of_coefficients(map.size());
    map.for_each([&](unsigned a, unsigned b) {
        double sum = 0;
        for (std::size_t node = 0; node < rule.nodes; ++node) {
            const double factor =
                corners == 3 ? triangle_factor(p, lattice[node], a, b) : square_factor(p, lattice[node], a, b);
            if (factor != 0) of_coefficients[map.at(a, b)].push_back({node, factor});
            sum += std::abs(factor);
        }
        rule.largest_row = std::max(rule.largest_row, sum);
    });
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

const DeterminantRule& rule_of(unsigned corners, unsigned order) {
    static const RulesByOrder triangles = make_rules(3), squares = make_rules(4);
    return (corners == 3 ? triangles : squares)[order];
}

// ---- coefficients of several cells side by side -----------------------------------------------------------------------

// Operations on all lanes at once, which the compiler makes for wider registers once more. Each lane does what it would
// do alone, so that no bit depends on the others.

constexpr std::size_t most_nodes = nodes_of_cell(4, max_cell_order);

using Lanes = JacobianBatch::Lanes;

inline void raise_to(Lanes& a, const Lanes& b) { a = a < b ? b : a; }
inline void lower_to(Lanes& a, const Lanes& b) { a = b < a ? b : a; }
inline void raise_to_size(Lanes& a, const Lanes& b) {
    raise_to(a, b);
    raise_to(a, -b);
}

constexpr std::size_t most_coefficients = std::size_t{4} * max_cell_order * max_cell_order;

/// The largest sizes of numbers and of their errors.
struct Magnitudes {
    Lanes size{}, error{};
};

/// The derivatives of one coordinate, but for a factor and times their weights, and how large they are.
struct Derivatives {
    std::array<Lanes, std::size_t{max_cell_order + 1} * max_cell_order> along, across;
    Magnitudes largest;
};

/// Puts the coefficients of the derivative along one direction, times their weights, into `values`, and the largest of
/// their sizes without weights into `largest`.
template <class Values>
inline void differentiate(const std::vector<Difference>& differences, const std::array<Lanes, most_nodes>& map,
                          Values& values, Lanes& largest) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const Lanes difference = map[differences[i].plus] - map[differences[i].minus];
        raise_to_size(largest, difference);
        values[i] = differences[i].weight * difference;
    }
}

/// Coordinates count from the first node on, which makes them small.
inline void differentiate(const DeterminantRule& rule, const std::array<Lanes, most_nodes>& nodes,
                          Derivatives& result) {
    const std::size_t n = rule.nodes;
    std::array<Lanes, most_nodes> local, map;
    Lanes largest{};
    for (std::size_t i = 0; i < n; ++i) {
        local[i] = nodes[i] - nodes[0];
        raise_to_size(largest, local[i]);
    }
    for (std::size_t a = 0; a < n; ++a) {
        Lanes sum{};
        for (std::size_t k = rule.first_factor[a]; k < rule.first_factor[a + 1]; ++k)
            sum += rule.to_bernstein[k].value * local[rule.to_bernstein[k].node];
        map[a] = sum;
    }
    result.largest = {};
    differentiate(rule.along, map, result.along, result.largest.size);
    differentiate(rule.across, map, result.across, result.largest.size);
    // Each of n products and sums rounds, and so has the local coordinate (Higham, section 3.1).
    const double of_map = (static_cast<double>(n) + 2) * rounding_unit * rule.largest_row;
    result.largest.error = 2 * of_map * largest + rounding_unit * result.largest.size;
}

/// The derivatives of straight cells at their sides, and how far nodes are off these cells: one coordinate.
struct StraightSides {
    std::array<Lanes, 2> along, across;  ///< by s at t = 0 and 1, and by t at s = 0 and 1
    Lanes largest_along{}, largest_across{}, largest{}, bend{};
};

inline void measure_sides(unsigned corners, unsigned p, const std::array<Lanes, most_nodes>& nodes,
                          StraightSides& sides) {
    const std::span<const LatticePlace> lattice = lattice_of_cell(corners, p);
    const Lanes a = nodes[1] - nodes[0], b = nodes[2] - nodes[0], c = nodes[corners - 1] - nodes[0];
    const Lanes twist = corners == 3 ? Lanes{} : b - a - c;
    sides.along = {a, a + twist};
    sides.across = {c, c + twist};
    for (std::size_t k = 0; k < 2; ++k) {
        raise_to_size(sides.largest_along, sides.along[k]);
        raise_to_size(sides.largest_across, sides.across[k]);
    }
    sides.largest = sides.largest_along + sides.largest_across;
    for (std::size_t n = corners; n < lattice.size(); ++n) {
        const double s = static_cast<double>(lattice[n].i) / p, t = static_cast<double>(lattice[n].j) / p;
        raise_to_size(sides.bend, nodes[n] - nodes[0] - s * a - t * c - (s * t) * twist);
    }
    sides.bend += 64 * rounding_unit * sides.largest;  // of a dozen operations on numbers up to twice this large
}

/// Bounds of the determinants of cells from those of the straight cells with the same corners.
struct StraightBounds {
    Lanes lower, upper;
    Lanes error;  ///< what is taken off and added for bends and rounding

    /// Returns whether the bounds of a cell are as good as those by its coefficients.
    bool are_tight(std::size_t lane) const {
        return lower[lane] > 0 && upper[lane] < largest_number && error[lane] < 0x1p-20 * lower[lane];
    }
};

/// The derivative of what is off the straight cell is at most slope_of_bend times the largest distance, and the
/// determinant of a straight cell lies between those at its corners.
inline void bound_straight(unsigned corners, unsigned p, double slope, const JacobianBatch& batch,
                           StraightBounds& bounds) {
    StraightSides x, y;
    measure_sides(corners, p, batch.x, x);
    measure_sides(corners, p, batch.y, y);
    for (std::size_t k = 0; k < 4; ++k) {
        const Lanes determinant = x.along[k / 2] * y.across[k % 2] - y.along[k / 2] * x.across[k % 2];
        if (k == 0) bounds.lower = bounds.upper = determinant;
        lower_to(bounds.lower, determinant);
        raise_to(bounds.upper, determinant);
    }
    constexpr double for_underflow = 1e-290, for_rounding_of_this = 2;
    const Lanes of_rounding = 64 * rounding_unit * x.largest * y.largest;
    const Lanes of_bend = slope * (x.largest * y.bend + y.largest * x.bend) + 2 * slope * slope * x.bend * y.bend;
    bounds.error = for_rounding_of_this * (of_rounding + of_bend) + for_underflow;
    bounds.lower -= bounds.error;
    bounds.upper += bounds.error;
}

/// Coefficients of determinants, and what is known of them.
struct Determinants {
    std::array<Lanes, most_coefficients> coefficients;
    Lanes radius;             ///< each coefficient is within this of the exact one
    Lanes smallest, largest;  ///< of the coefficients
    Lanes sum;                ///< of their sizes; not finite where one of them is not
    StraightBounds straight;  ///< where all cells are as good as straight, there is nothing else
};

/// Bounds the errors of the sums of products x y' - x' y, whose weights amount to 1.
inline void bound_errors(const DeterminantRule& rule, const Magnitudes& x, const Magnitudes& y, Lanes& radius) {
    constexpr double for_rounding_of_this = 1 + 0x1p-20, for_underflow = 1e-290;
    const Lanes of_factors = 2 * (x.size * y.error + y.size * x.error + x.error * y.error);
    const Lanes of_products = 2 * x.size * y.size;  // not finite where a product is not
    const Lanes of_sums = of_products * ((static_cast<double>(rule.terms_of_one) + 6) * rounding_unit);
    radius = for_rounding_of_this * (of_factors + of_sums) + for_underflow;
}

inline void bound_coefficients(const DeterminantRule& rule, const JacobianBatch& batch, Determinants& determinants) {
    Derivatives x, y;
    differentiate(rule, batch.x, x);
    differentiate(rule, batch.y, y);
    bound_errors(rule, x.largest, y.largest, determinants.radius);
    const std::size_t n = rule.grid.size();
    for (std::size_t c = 0; c < n; ++c) {
        Lanes sum{};
        for (std::size_t k = rule.first_term[c]; k < rule.first_term[c + 1]; ++k) {
            const ProductTerm& t = rule.terms[k];
            sum += x.along[t.along] * y.across[t.across] - y.along[t.along] * x.across[t.across];
        }
        determinants.coefficients[c] = sum / rule.weights[c];
    }
    determinants.smallest = determinants.largest = determinants.coefficients[0];
    determinants.sum = Lanes{};
    for (std::size_t c = 0; c < n; ++c) {
        const Lanes& of_cells = determinants.coefficients[c];
        lower_to(determinants.smallest, of_cells);
        raise_to(determinants.largest, of_cells);
        Lanes size = of_cells;
        raise_to(size, -of_cells);
        determinants.sum += size;
    }
}

/// Bounds the determinants of straight cells by their corners, and those of others by their coefficients.
inline void bound_lanes(const DeterminantRule& rule, const JacobianBatch& batch, Determinants& determinants) {
    bound_straight(rule.grid.corners, rule.order, rule.slope_of_bend, batch, determinants.straight);
    std::size_t tight = 0;
    while (tight < batch.size && determinants.straight.are_tight(tight)) ++tight;
    if (tight < batch.size) bound_coefficients(rule, batch, determinants);
}

[[gnu::flatten]] void bound_all(const DeterminantRule& rule, const JacobianBatch& batch, Determinants& determinants) {
    bound_lanes(rule, batch, determinants);
}

#if defined(__x86_64__) && defined(__GNUC__)
[[gnu::target("avx2"), gnu::flatten]] void bound_all_avx2(const DeterminantRule& rule, const JacobianBatch& batch,
                                                          Determinants& determinants) {
    bound_lanes(rule, batch, determinants);
}
bool has_avx2() { return __builtin_cpu_supports("avx2") != 0; }
#else
void bound_all_avx2(const DeterminantRule& rule, const JacobianBatch& batch, Determinants& determinants) {
    bound_all(rule, batch, determinants);
}
constexpr bool has_avx2() { return false; }
#endif

// ---- halving ---------------------------------------------------------------------------------------------------------

/// Coefficients of the determinant: as many as quadrilaterals of the highest order have; others leave some unused.
using Coefficients = std::array<double, most_coefficients>;

/// Coefficients of the determinant on a part of the cell, each of which is within `radius` of the exact one.
struct Part {
    Coefficients coefficients{};
    double radius = 0;
    int halvings = 0;
};

/// Halves a polynomial in one variable by de Casteljau's algorithm. Its n + 1 coefficients are at places place(k);
/// `first` holds them, and those of the first half afterwards.
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

/// Returns the bounds of a cell some of whose coefficients are not above their error, by halving it.
JacobianBounds bound_by_halving(const DeterminantRule& rule, Part part, double upper) {
    const JacobianBounds bounds{.upper = upper};
    const auto of_part = [&](const Part& p) { return std::span(p.coefficients).first(rule.grid.size()); };
    std::vector<Part> undecided;
    double lower = HUGE_VAL;
    for (;;) {
        for (const std::size_t corner : rule.corners)
            if (part.coefficients[corner] < -part.radius) return {CellVerdict::invalid, 0, bounds.upper};
        const auto coefficients = of_part(part);
        const double smallest = *std::min_element(coefficients.begin(), coefficients.end()) - part.radius;
        if (smallest > 0) {
            lower = std::min(lower, smallest);
            if (undecided.empty()) break;
            part = undecided.back();
            undecided.pop_back();
            continue;
        }
        // What is not above its own error cannot be proved positive by any number of halvings.
        if (part.halvings == max_halvings ||
            !(*std::max_element(coefficients.begin(), coefficients.end()) > part.radius))
            return bounds;
        const auto [first, second] = halves_of(rule.grid, part);
        undecided.push_back(first);
        part = second;
    }
    return {CellVerdict::valid, (1 - for_rounding_of_scale) * rule.scale * lower, bounds.upper};
}

/// Returns the bounds of one of the cells.
JacobianBounds bounds_of(const DeterminantRule& rule, const Determinants& determinants, std::size_t lane) {
    const StraightBounds& straight = determinants.straight;
    if (straight.are_tight(lane)) return {CellVerdict::valid, straight.lower[lane], straight.upper[lane]};
    const double radius = determinants.radius[lane], lower = determinants.smallest[lane] - radius;
    if (!(radius < largest_number && determinants.sum[lane] < largest_number))
        return {CellVerdict::unproved, 0, HUGE_VAL};
    double upper = rule.scale * (determinants.largest[lane] + radius);
    upper += for_rounding_of_scale * std::abs(upper);
    if (lower > 0) return {CellVerdict::valid, (1 - for_rounding_of_scale) * rule.scale * lower, upper};
    Part whole{{}, radius, 0};
    for (std::size_t c = 0; c < rule.grid.size(); ++c) whole.coefficients[c] = determinants.coefficients[c][lane];
    return bound_by_halving(rule, whole, upper);
}

}  // namespace

std::array<JacobianBounds, JacobianBatch::capacity> bound_jacobians(unsigned corners, unsigned order,
                                                                    const JacobianBatch& batch) {
    const DeterminantRule& rule = rule_of(corners, order);
    Determinants determinants;
    (has_avx2() ? bound_all_avx2 : bound_all)(rule, batch, determinants);
    std::array<JacobianBounds, JacobianBatch::capacity> bounds;
    for (std::size_t lane = 0; lane < batch.size; ++lane) bounds[lane] = bounds_of(rule, determinants, lane);
    return bounds;
}

JacobianBounds bound_jacobian(unsigned corners, unsigned order, std::span<const Point> nodes) {
    assert(nodes.size() == nodes_of_cell(corners, order));
    JacobianBatch batch;
    for (std::size_t i = 0; i < nodes.size(); ++i) batch.put(i, nodes[i]);
    batch.add_cell();
    return bound_jacobians(corners, order, batch)[0];
}

}  // namespace lamina::mesh
