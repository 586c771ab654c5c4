// How the nodes of a cell become the Bernstein coefficients of the determinant of its Jacobian: what depends on the
// shape and the order of the cell alone. Source: G. Farin, Curves and Surfaces for CAGD (2002), chapters 5 and 17.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <lamina/curved_mesh.hpp>
#include <lamina/export.hpp>

namespace lamina::mesh {

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
    double weight(unsigned i, unsigned j) const;
};

/// The difference of two Bernstein coefficients of the map, one of its derivative.
struct Difference {
    std::size_t plus, minus;
    double weight;  ///< of the coefficient in products
};

/// The part of a coefficient of the map that a node has.
struct NodeFactor {
    std::size_t node;
    double value;  ///< a whole number for nodes that are evenly spaced; not 0
};

/// The part of a coefficient of the determinant that two derivatives have.
struct ProductTerm {
    std::uint32_t along, across;  ///< places in the lists of derivatives
};

/// How the nodes of a curve of order p become a factor times its Bernstein coefficients, and what weighs coefficients.
struct CurveRule {
    double largest_row = 0;  ///< of the factors below
    double factor = 1;       ///< (p!)^2, which makes them whole where nodes are evenly spaced, else 1
    std::array<std::array<double, max_cell_order + 1>, max_cell_order + 1> to_bernstein{};  ///< [coefficient][node]
    std::array<double, max_cell_order + 1> weights{};                                       ///< of degree p
    std::array<double, max_cell_order> weights_of_derivative{};                             ///< of degree p - 1
    std::array<double, std::size_t{2} * max_cell_order> weights_of_product{};               ///< of degree 2 p - 1
};

/// How nodes become the coefficients of the determinant, but for the factor `scale`.
struct DeterminantRule {
    CoefficientGrid grid;  ///< of the determinant
    unsigned order = 1;
    std::size_t nodes = 0;
    std::vector<NodeFactor> to_bernstein;   ///< coefficient by coefficient of the map
    std::vector<std::size_t> first_factor;  ///< of each coefficient of the map, then the end
    double largest_row = 0;                 ///< largest sum of the sizes of the factors of a coefficient
    /// The largest sum of the rounding errors of the factors of a coefficient, over largest_row; 0 where they are
    /// whole.
    double error_of_factors = 0;
    NodeDistribution distribution = NodeDistribution::equidistant;
    std::vector<Difference> along, across;
    std::vector<ProductTerm> terms;       ///< coefficient by coefficient
    std::vector<std::size_t> first_term;  ///< of each coefficient of the determinant, then the end
    std::size_t terms_of_one = 0;         ///< largest number of terms of one coefficient
    std::vector<double> weights;          ///< of the coefficients, which are sums of products over their weight
    double slope_of_bend = 1;             ///< no derivative of a map with nodes up to 1 has larger coefficients
    double scale = 1;                     ///< the determinant over what the terms amount to
    std::vector<std::size_t> corners;     ///< the coefficients that are values at the corners
    CurveRule curve;                      ///< of the edges of squares
};

/// Returns the rule of cells with 3 or 4 corners. Precondition: 1 <= order <= max_cell_order.
const DeterminantRule& determinant_rule(unsigned corners, unsigned order, NodeDistribution distribution);

/// Returns Lagrange's polynomials of the nodes of a triangle, in their order, at a place.
LAMINA_EXPORT std::vector<double> lagrange_in_triangle(unsigned order, NodeDistribution distribution, double s,
                                                       double t);

}  // namespace lamina::mesh
