#include "layers/directions/leans.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "core/rounding.hpp"
#include "layers/directions/corners.hpp"
#include "layers/parameters.hpp"

namespace lamina::layers {

namespace {

/// The gradient and the Hessian of half the function at some leans. Leans that are held at a bound have a row of the
/// identity.
struct Derivatives {
    std::vector<double> gradient, diagonal;
    std::vector<double> beside;    ///< entry k of the Hessian is that of rays k and k + 1
    std::vector<char> conditions;  ///< which terms of the columns count, and which leans are held

    explicit Derivatives(std::size_t n) : gradient(n), diagonal(n), beside(n), conditions(2 * n) {}
};

/// Half of the function that is minimised.
class Chain {
public:
    Chain(std::span<const ColumnLack> lacks, std::span<const LeanBounds> bounds, double stiffness)
        : lacks_(lacks), bounds_(bounds), stiffness_(stiffness) {}

    std::size_t size() const { return lacks_.size(); }
    double clamped(std::size_t i, double lean) const { return std::clamp(lean, bounds_[i].least, bounds_[i].most); }

    double value(std::span<const double> leans) const {
        double sum = 0;
        for (std::size_t k = 0; k < size(); ++k) {
            const ColumnLack left = lack_left(leans, k);
            sum +=
                0.5 * (positive_square(left.wanted) + positive_square(left.least) + stiffness_ * leans[k] * leans[k]);
        }
        return sum;
    }

    void set_derivatives(std::span<const double> leans, Derivatives& d) const {
        for (std::size_t k = 0; k < size(); ++k) {
            d.gradient[k] = stiffness_ * leans[k];
            d.diagonal[k] = stiffness_;
        }
        for (std::size_t k = 0; k < size(); ++k) {
            const ColumnLack left = lack_left(leans, k);
            const double pull = std::max(left.wanted, 0.0) + std::max(left.least, 0.0);
            const double curvature = (left.wanted > 0 ? 1 : 0) + (left.least > 0 ? 1 : 0);
            d.conditions[k] = static_cast<char>((left.wanted > 0 ? 1 : 0) + (left.least > 0 ? 2 : 0));
            d.gradient[k] += pull;
            d.gradient[next(k)] -= pull;
            d.diagonal[k] += curvature;
            d.diagonal[next(k)] += curvature;
            d.beside[k] = -curvature;
        }
        for (std::size_t k = 0; k < size(); ++k) {
            d.conditions[size() + k] = is_held(leans[k], d.gradient[k], bounds_[k]);
            if (!d.conditions[size() + k]) continue;
            d.gradient[k] = 0;
            d.diagonal[k] = 1;
            d.beside[k] = d.beside[k > 0 ? k - 1 : size() - 1] = 0;
        }
    }

    /// Returns how far the gradient would take a lean that is free to move.
    double residual(std::span<const double> leans, const Derivatives& d) const {
        double largest = 0;
        for (std::size_t k = 0; k < size(); ++k)
            largest = std::max(largest, std::abs(clamped(k, leans[k] - d.gradient[k]) - leans[k]));
        return largest;
    }

private:
    std::span<const ColumnLack> lacks_;
    std::span<const LeanBounds> bounds_;
    double stiffness_;

    std::size_t next(std::size_t k) const { return k + 1 < size() ? k + 1 : 0; }
    ColumnLack lack_left(std::span<const double> leans, std::size_t k) const {
        const double opening = leans[next(k)] - leans[k];
        return {lacks_[k].wanted - opening, lacks_[k].least - opening};
    }
    static double positive_square(double x) { return x > 0 ? x * x : 0; }
    /// Returns whether a lean stays at a bound, beyond which the function falls.
    static bool is_held(double lean, double gradient, const LeanBounds& bounds) {
        return (lean <= bounds.least && gradient >= 0) || (lean >= bounds.most && gradient <= 0);
    }
};

/// Solves the tridiagonal system T x = right by elimination.
void solve_tridiagonal(std::span<const double> diagonal, std::span<const double> beside, std::span<double> x) {
    std::vector<double> pivots(diagonal.begin(), diagonal.end());
    for (std::size_t i = 1; i < x.size(); ++i) {
        const double factor = beside[i - 1] / pivots[i - 1];
        pivots[i] -= factor * beside[i - 1];
        x[i] -= factor * x[i - 1];
    }
    for (std::size_t i = x.size(); i-- > 0;) {
        if (i + 1 < x.size()) x[i] -= beside[i] * x[i + 1];
        x[i] /= pivots[i];
    }
}

/// Solves the cyclic tridiagonal system, which is positive definite. The last unknown is a border:
///
///     | T   v | | x |   | b |
///     | v^T d | | y | = | c |      y = (c - v^T T^-1 b) / (d - v^T T^-1 v),  x = T^-1 b - y T^-1 v
///
std::vector<double> solve_cyclic(const Derivatives& d) {
    const std::size_t m = d.diagonal.size() - 1;
    std::vector<double> x = d.gradient, border(m, 0.0);
    border[0] = d.beside[m];
    border[m - 1] = d.beside[m - 1];
    const std::span<const double> diagonal = std::span(d.diagonal).first(m);
    solve_tridiagonal(diagonal, d.beside, std::span(x).first(m));
    solve_tridiagonal(diagonal, d.beside, border);
    const auto times_border = [&](const std::vector<double>& values) {
        return d.beside[m] * values[0] + d.beside[m - 1] * values[m - 1];
    };
    x[m] = (d.gradient[m] - times_border(x)) / (d.diagonal[m] - times_border(border));
    for (std::size_t i = 0; i < m; ++i) x[i] -= x[m] * border[i];
    return x;
}

}  // namespace

ChainLeans minimise_leans(std::span<const ColumnLack> lacks, std::span<const LeanBounds> bounds, double stiffness) {
    assert(lacks.size() >= 3 && lacks.size() == bounds.size() && stiffness > 0);
    constexpr std::size_t max_steps = 200;    // each lowers the function; outlines of thousands of corners take 20
    constexpr double sufficient = 1e-4;       // share of the decrease that the gradient promises (Armijo)
    constexpr double shortest = 1e-9;         // of a step
    constexpr double least_residual = 1e-14;  // of leans, and of the function
    const Chain chain(lacks, bounds, stiffness);
    const std::size_t n = chain.size();
    ChainLeans result{std::vector<double>(n), 0};
    for (std::size_t i = 0; i < n; ++i) result.leans[i] = chain.clamped(i, 0);
    Derivatives here(n), there(n);
    std::vector<double> trial(n);
    double value = chain.value(result.leans);
    chain.set_derivatives(result.leans, here);
    for (; result.steps < max_steps; ++result.steps) {
        if (chain.residual(result.leans, here) < least_residual) break;
        const std::vector<double> step = solve_cyclic(here);
        double share = 1, lower = value;
        for (; share > shortest; share *= 0.5) {
            double promised = 0;
            for (std::size_t i = 0; i < n; ++i) {
                trial[i] = chain.clamped(i, result.leans[i] - share * step[i]);
                promised += here.gradient[i] * (result.leans[i] - trial[i]);
            }
            lower = chain.value(trial);
            if (lower <= value - sufficient * promised + least_residual * value) break;
        }
        if (share <= shortest) break;
        result.leans.swap(trial);
        value = lower;
        chain.set_derivatives(result.leans, there);
        if (share == 1 && there.conditions == here.conditions) break;
        std::swap(here, there);
    }
    return result;
}

LeanBounds fan_bounds(const WallVertex& vertex, bool is_last) {
    const double most = core::radians(most_fan_lean_deg), given = std::min(most, most_given_share * vertex.turning);
    const LeanBounds free = is_last ? LeanBounds{-given, most} : LeanBounds{-most, given};
    if (vertex.lines.empty()) return free;
    const double to_line =
        is_last ? vertex.lines.back().angle - 0.5 * vertex.turning : vertex.lines.front().angle + 0.5 * vertex.turning;
    const bool is_outside = is_last ? to_line > 0 : to_line < 0;
    if (is_outside || vertex.turning <= 0) return {to_line, to_line};
    return is_last ? LeanBounds{std::max(-given, to_line), most} : LeanBounds{-most, std::min(given, to_line)};
}

namespace {

/// Returns the largest lean that lines ask of rays beside them, which otherwise meet those along the lines: that of a
/// line, but no more than slants allow.
double lean_beside_lines(std::span<const WallVertex> vertices) {
    double most = 0;
    for (const WallVertex& vertex : vertices)
        if (!vertex.lines.empty()) most = std::max({most, std::abs(vertex.lean[0]), std::abs(vertex.lean[1])});
    return std::min(most, core::atan2_reproducible(std::sqrt(max_slant * max_slant - 1), 1));
}

/// Returns the bounds of the lean of the one ray of a vertex. shorter_edge: length of the shorter one of its edges;
/// beside_lines: lean_beside_lines().
LeanBounds bounds_of_ray(const WallVertex& vertex, double first_height, double shorter_edge, double beside_lines) {
    if (!vertex.lines.empty()) return {vertex.lean[0], vertex.lean[0]};
    const double from_normals =
        std::max(core::radians(most_lean_from_normals_deg), beside_lines) - 0.5 * std::abs(vertex.turning);
    const double most = std::min({std::max(core::radians(most_lean_deg), beside_lines), from_normals,
                                  max_lean_between_edges(vertex.turning, first_height, shorter_edge)});
    return {-std::max(most, 0.0), std::max(most, 0.0)};
}

/// The chain of an outline: its rays, and the columns behind them.
struct Leaners {
    std::vector<ColumnLack> lacks;
    std::vector<LeanBounds> bounds;
    std::vector<double*> leans;
};

/// Returns the chain problem of an outline: what its columns lack without leans, and where the leans of its rays go.
/// Widths are measured at so many heights of the front.
Leaners leaners_of(std::span<const RayVertex> outline, std::span<const double> heights, double fronts, double wanted,
                   double first_height, std::span<WallVertex> vertices) {
    const std::size_t n = outline.size();
    constexpr ColumnLack nothing{-HUGE_VAL, -HUGE_VAL};
    Leaners result;
    const double beside_lines = lean_beside_lines(vertices);
    double edge_before = distance(outline[n - 1].at, outline[0].at);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = i + 1 < n ? i + 1 : 0;
        WallVertex &vertex = vertices[i], &after = vertices[next];
        const double edge = distance(outline[i].at, outline[next].at),
                     height = fronts * std::max(heights[i], heights[next]);
        if (vertex.fan) {
            result.lacks.push_back(nothing);
            result.bounds.insert(result.bounds.end(), {fan_bounds(vertex, false), fan_bounds(vertex, true)});
            result.leans.push_back(&vertex.lean[0]);
        } else {
            result.bounds.push_back(bounds_of_ray(vertex, first_height, std::min(edge_before, edge), beside_lines));
        }
        result.leans.push_back(&vertex.lean[vertex.fan]);
        const double opening = (vertex.fan ? 0 : 0.5 * vertex.turning) + (after.fan ? 0 : 0.5 * after.turning);
        const double width = edge / height;
        const ColumnLack lack{wanted - width - opening, -width / clearance - opening};
        result.lacks.push_back(height > 0 ? lack : nothing);
        edge_before = edge;
    }
    return result;
}

}  // namespace

double most_opening(OutlineKind kind, const LayerOptions& options) {
    const double angle = core::radians(options.max_ray_angle_deg);
    return kind == OutlineKind::jagged ? std::max(angle, core::radians(max_jagged_ray_angle_deg)) : angle;
}

void lean_rays(std::span<const RayVertex> outline, std::span<const double> heights, OutlineKind kind,
               const LayerOptions& options, const LayerGrowth& growth, std::vector<WallVertex>& vertices) {
    constexpr double lean_step = 0x1p-12;  // radians: leans that differ by rounding errors become equal
    // Columns need be no wider than where corners follow each other, however far rays may diverge.
    const double angle = std::min(most_opening(kind, options), core::radians(max_jagged_ray_angle_deg));
    const bool isotropic = !growth.layers && growth.least_heights.empty();
    const double fan_angle = std::min(core::radians(options.max_ray_angle_deg), angle);
    // On walls of twice as many edges and rays at half the angle a lack is spread over twice as many columns.
    const double stiffness = lean_stiffness * fan_angle * fan_angle;
    // Rays of points that were given stay near their normals: they must not meet, and no more.
    const double wanted = kind == OutlineKind::given ? -HUGE_VAL : wanted_width_in_openings * angle;
    const Leaners leaners =
        leaners_of(outline, heights, isotropic ? fronts_of_isotropy : 1, wanted, growth.first_height, vertices);
    const ChainLeans solution = minimise_leans(leaners.lacks, leaners.bounds, stiffness);
    for (std::size_t k = 0; k < leaners.leans.size(); ++k)
        *leaners.leans[k] = core::rounded_to_multiple(solution.leans[k], lean_step);
    for (WallVertex& vertex : vertices)
        if (!vertex.fan) vertex.lean[1] = vertex.lean[0];
}

}  // namespace lamina::layers
