// Source: A. Johnen, J.-F. Remacle, C. Geuzaine, J. Comput. Phys. 233 (2013); subdivision: G. Farin, Curves and
// Surfaces for CAGD (2002), chapter 5; bounds of rounding errors: N. J. Higham, Accuracy and Stability of Numerical
// Algorithms (2002), chapter 3.
#include "mesh/jacobian_bounds.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/cell_lattice.hpp"
#include "mesh/determinant_rule.hpp"

namespace lamina::mesh {

namespace {

constexpr int max_halvings = 2 * 12;  // in two directions by turns
constexpr double rounding_unit = 0x1p-53, for_rounding_of_scale = 0x1p-50;
constexpr double largest_number = 0x1p1022;  // sums of a coefficient and its error do not overflow

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
    const double of_map = ((static_cast<double>(n) + 2) * rounding_unit + rule.error_of_factors) * rule.largest_row;
    result.largest.error = 2 * of_map * largest + rounding_unit * result.largest.size;
}

/// The derivatives of straight cells at their sides, and how far nodes are off these cells: one coordinate.
struct StraightSides {
    std::array<Lanes, 2> along, across;  ///< by s at t = 0 and 1, and by t at s = 0 and 1
    Lanes largest_along{}, largest_across{}, largest{}, bend{};
};

inline void measure_sides(unsigned corners, std::span<const NodePlace> places,
                          const std::array<Lanes, most_nodes>& nodes, StraightSides& sides) {
    const Lanes a = nodes[1] - nodes[0], b = nodes[2] - nodes[0], c = nodes[corners - 1] - nodes[0];
    const Lanes twist = corners == 3 ? Lanes{} : b - a - c;
    sides.along = {a, a + twist};
    sides.across = {c, c + twist};
    for (std::size_t k = 0; k < 2; ++k) {
        raise_to_size(sides.largest_along, sides.along[k]);
        raise_to_size(sides.largest_across, sides.across[k]);
    }
    sides.largest = sides.largest_along + sides.largest_across;
    for (std::size_t n = corners; n < places.size(); ++n) {
        const double s = places[n].s, t = places[n].t;
        raise_to_size(sides.bend, nodes[n] - nodes[0] - s * a - t * c - (s * t) * twist);
    }
    sides.bend += 64 * rounding_unit * sides.largest;  // of a dozen operations on numbers up to twice this large
}

/// Bounds of the determinants of cells from those of simpler ones, such as the straight cells with the same corners.
struct SimpleBounds {
    Lanes lower{}, upper{};
    Lanes error{};  ///< what is taken off and added for what nodes are off the simpler cells, and for rounding

    /// Returns whether the bounds of a cell are as good as those by its coefficients.
    bool are_tight(std::size_t lane) const {
        return lower[lane] > 0 && upper[lane] < largest_number && error[lane] < 0x1p-20 * lower[lane];
    }
};

/// Adds how much nodes that are off a map change its determinant, where the sizes of both derivatives of x and y amount
/// to so much: the derivative of what they are off is at most slope_of_bend times the largest distance.
inline void add_error_of_bend(double slope, const Lanes& x_size, const Lanes& x_bend, const Lanes& y_size,
                              const Lanes& y_bend, Lanes& error) {
    error += slope * (x_size * y_bend + y_size * x_bend) + 2 * slope * slope * x_bend * y_bend;
}

/// The determinant of a straight cell lies between those at its corners.
inline void bound_straight(const DeterminantRule& rule, const JacobianBatch& batch, SimpleBounds& bounds) {
    StraightSides x, y;
    const std::span<const NodePlace> places = places_of_nodes(rule.grid.corners, rule.order, rule.distribution);
    measure_sides(rule.grid.corners, places, batch.x, x);
    measure_sides(rule.grid.corners, places, batch.y, y);
    for (std::size_t k = 0; k < 4; ++k) {
        const Lanes determinant = x.along[k / 2] * y.across[k % 2] - y.along[k / 2] * x.across[k % 2];
        if (k == 0) bounds.lower = bounds.upper = determinant;
        lower_to(bounds.lower, determinant);
        raise_to(bounds.upper, determinant);
    }
    constexpr double for_underflow = 1e-290, for_rounding_of_this = 2;
    bounds.error = 64 * rounding_unit * x.largest * y.largest;
    add_error_of_bend(rule.slope_of_bend, x.largest, x.bend, y.largest, y.bend, bounds.error);
    bounds.error = for_rounding_of_this * bounds.error + for_underflow;
    bounds.lower -= bounds.error;
    bounds.upper += bounds.error;
}

/// Bounds the errors of the sums of products x y' - x' y, whose weights amount to 1, so many of each kind in a sum.
inline void bound_errors(std::size_t terms, const Magnitudes& x, const Magnitudes& y, Lanes& radius) {
    constexpr double for_rounding_of_this = 1 + 0x1p-20, for_underflow = 1e-290;
    const Lanes of_factors = 2 * (x.size * y.error + y.size * x.error + x.error * y.error);
    const Lanes of_products = 2 * x.size * y.size;  // not finite where a product is not
    const Lanes of_sums = of_products * ((static_cast<double>(terms) + 6) * rounding_unit);
    radius = for_rounding_of_this * (of_factors + of_sums) + for_underflow;
}

/// The curves of the edges of cells from the first and the second corner to the ones opposite, as if all nodes between
/// them were on straight lines from one curve to the other: one coordinate. Coefficients have the factor of CurveRule.
struct TwoCurves {
    using Coefficients = std::array<Lanes, max_cell_order + 1>;
    std::array<Coefficients, 2> slopes;  ///< differences of the coefficients of each, times their weights
    Coefficients across;                 ///< from the first curve to the second, times their weights
    Magnitudes largest;                  ///< of both without weights
    Lanes bend{};                        ///< how far nodes are off the lines, times no factor
};

inline void measure_curves(const DeterminantRule& of_cell, std::span<const LatticePlace> lattice,
                           const std::array<Lanes, most_nodes>& nodes, TwoCurves& curves) {
    const CurveRule& rule = of_cell.curve;
    const unsigned p = of_cell.order;
    std::array<std::array<Lanes, max_cell_order + 1>, max_cell_order + 1> local;  // by both steps
    Lanes largest{};
    for (std::size_t n = 0; n < lattice.size(); ++n) {
        Lanes& place = local[lattice[n].i][lattice[n].j];
        place = nodes[n] - nodes[0];
        raise_to_size(largest, place);
    }
    for (unsigned i = 1; i < p; ++i) {
        const double share = place_on_edge(p, i, of_cell.distribution);
        for (unsigned j = 0; j <= p; ++j)
            raise_to_size(curves.bend, local[i][j] - local[0][j] - share * (local[p][j] - local[0][j]));
    }
    curves.bend += 64 * rounding_unit * largest;  // of these operations, on numbers up to twice this large
    std::array<TwoCurves::Coefficients, 2> bernstein;
    for (std::size_t side = 0; side < 2; ++side)
        for (unsigned a = 0; a <= p; ++a) {
            Lanes sum{};
            for (unsigned node = 0; node <= p; ++node) sum += rule.to_bernstein[a][node] * local[side * p][node];
            bernstein[side][a] = sum;
        }
    for (unsigned a = 0; a <= p; ++a) {
        curves.across[a] = bernstein[1][a] - bernstein[0][a];
        raise_to_size(curves.largest.size, curves.across[a]);
        curves.across[a] *= rule.weights[a];
        for (std::size_t side = 0; side < 2 && a < p; ++side) {
            const Lanes slope = bernstein[side][a + 1] - bernstein[side][a];
            raise_to_size(curves.largest.size, slope);
            curves.slopes[side][a] = rule.weights_of_derivative[a] * slope;
        }
    }
    const double of_map = ((p + 3) * rounding_unit + of_cell.error_of_factors) * rule.largest_row;  // differentiate()
    curves.largest.error = 2 * of_map * largest + rounding_unit * curves.largest.size;
}

/// Bounds the determinants of cells that are linear along their first edges but for rounding, such as those of a
/// layer's columns: of the degree 1 along these and 2 p - 1 along the others.
inline void bound_linear(const DeterminantRule& rule, const JacobianBatch& batch, SimpleBounds& bounds) {
    const unsigned p = rule.order;
    const std::span<const LatticePlace> lattice = lattice_of_cell(4, p);
    TwoCurves x, y;
    measure_curves(rule, lattice, batch.x, x);
    measure_curves(rule, lattice, batch.y, y);
    for (std::size_t side = 0; side < 2; ++side) {
        std::array<Lanes, std::size_t{2} * max_cell_order> sums{};
        for (unsigned a = 0; a <= p; ++a)
            for (unsigned b = 0; b < p; ++b)
                sums[a + b] += x.across[a] * y.slopes[side][b] - y.across[a] * x.slopes[side][b];
        for (unsigned k = 0; k < 2 * p; ++k) {
            const Lanes determinant = sums[k] / rule.curve.weights_of_product[k];
            if (side + k == 0) bounds.lower = bounds.upper = determinant;
            lower_to(bounds.lower, determinant);
            raise_to(bounds.upper, determinant);
        }
    }
    constexpr double for_rounding_of_this = 2;
    const double scale = p / (rule.curve.factor * rule.curve.factor), of_size = (p + 1) / rule.curve.factor;
    bound_errors(p, x.largest, y.largest, bounds.error);
    bounds.lower *= scale;
    bounds.upper *= scale;
    bounds.error *= scale;
    const Lanes x_size = of_size * (x.largest.size + x.largest.error),
                y_size = of_size * (y.largest.size + y.largest.error);
    add_error_of_bend(rule.slope_of_bend, x_size, x.bend, y_size, y.bend, bounds.error);
    bounds.error = for_rounding_of_this * bounds.error + for_rounding_of_scale * bounds.upper;
    bounds.lower -= bounds.error;
    bounds.upper += bounds.error;
}

/// Coefficients of determinants, and what is known of them.
struct Determinants {
    std::array<Lanes, most_coefficients> coefficients;
    Lanes radius;             ///< each coefficient is within this of the exact one
    Lanes smallest, largest;  ///< of the coefficients
    Lanes sum;                ///< of their sizes; not finite where one of them is not
    SimpleBounds straight;    ///< where all cells are as good as straight, there is nothing else
    SimpleBounds linear;      ///< likewise for quadrilaterals that are linear in one direction

    /// Returns the bounds of a simpler cell that are as good as those by all coefficients, or null.
    const SimpleBounds* tight(std::size_t lane) const {
        return straight.are_tight(lane) ? &straight : linear.are_tight(lane) ? &linear : nullptr;
    }
};

inline void bound_coefficients(const DeterminantRule& rule, const JacobianBatch& batch, Determinants& determinants) {
    Derivatives x, y;
    differentiate(rule, batch.x, x);
    differentiate(rule, batch.y, y);
    bound_errors(rule.terms_of_one, x.largest, y.largest, determinants.radius);
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

/// Bounds the determinants of straight cells by their corners, those of quadrilaterals that are linear in one direction
/// by the curves on both sides, and those of others by all coefficients.
inline void bound_lanes(const DeterminantRule& rule, const JacobianBatch& batch, Determinants& determinants) {
    bound_straight(rule, batch, determinants.straight);
    const auto are_tight = [&] {
        std::size_t tight = 0;
        while (tight < batch.size && determinants.tight(tight) != nullptr) ++tight;
        return tight == batch.size;
    };
    if (are_tight()) return;
    if (rule.grid.corners == 4) {
        bound_linear(rule, batch, determinants.linear);
        if (are_tight()) return;
    }
    bound_coefficients(rule, batch, determinants);
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
    if (const SimpleBounds* simple = determinants.tight(lane); simple != nullptr)
        return {CellVerdict::valid, simple->lower[lane], simple->upper[lane]};
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
                                                                    const JacobianBatch& batch,
                                                                    NodeDistribution distribution) {
    const DeterminantRule& rule = determinant_rule(corners, order, distribution);
    Determinants determinants;
    (has_avx2() ? bound_all_avx2 : bound_all)(rule, batch, determinants);
    std::array<JacobianBounds, JacobianBatch::capacity> bounds;
    for (std::size_t lane = 0; lane < batch.size; ++lane) bounds[lane] = bounds_of(rule, determinants, lane);
    return bounds;
}

JacobianBounds bound_jacobian(unsigned corners, unsigned order, std::span<const Point> nodes,
                              NodeDistribution distribution) {
    assert(nodes.size() == nodes_of_cell(corners, order));
    JacobianBatch batch;
    for (std::size_t i = 0; i < nodes.size(); ++i) batch.put(i, nodes[i]);
    batch.add_cell();
    return bound_jacobians(corners, order, batch, distribution)[0];
}

}  // namespace lamina::mesh
