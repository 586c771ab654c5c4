// Columns of heights that end where the space for them does. Layers of fixed heights under a limit that varies along
// the wall would end in steps of a whole layer, a fifth of the height at a growth of 1.2:
//
//          . - - - .                        . - - - .
//       .     ___     .                  . /         \ .           . .  limits of the rays
//     .   ___|   |___   .              . /             \ .         ___  ends of the layers
//   .  __|           |__  .          . /                 \ .
//         fixed heights                   fitted heights
//
// A growth that differs by some per mille, the less the more layers there are, makes a layer end at the limit. It
// differs in the upper half of the layers alone. Cells near the wall are a thousand times as long as high, so where
// their ends differ in height by one more per mille from row to row, the middles of neighbouring rows shift against
// each other by more than the rows are high, and faces are far from orthogonal:
//
//      _________________              _________________
//     |_________________|            |_________________|        Left: rows whose ends differ by more from row to row.
//     |_____.-----------|            |_________________|        Right: rows that differ alike, as rows of the same
//     |-----____________|            |_________________|        heights do everywhere.
#include "layers/heights/stretch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/predicates.hpp"
#include "core/reproducible_math.hpp"
#include "layers/layered_rays.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// The height of the topmost of n layers that are stretched, and how it changes with the factor.
struct StretchedHeight {
    double height, slope;
};

StretchedHeight stretched_height(std::span<const double> heights, std::uint32_t n, double factor) {
    const std::uint32_t kept = std::min(last_unstretched(n), n);
    StretchedHeight top{heights[kept], 0};
    double product = 1;
    for (std::uint32_t k = kept; k < n; ++k) {
        const double thickness = heights[k + 1] - heights[k];
        top.slope += (k - kept + 1) * product * thickness;
        product *= factor;
        top.height += product * thickness;
    }
    return top;
}

/// Returns the factor, from 1 / max_stretch to max_stretch, with which layer n ends next to the height, by Newton's
/// method from a factor that is too large: the height is a polynomial of the factor with positive coefficients, so no
/// step goes too far.
double factor_to_height(double height, std::span<const double> heights, std::uint32_t n) {
    if (stretched_height(heights, n, 1 / max_stretch).height >= height) return 1 / max_stretch;
    double factor = max_stretch;
    for (;;) {
        const StretchedHeight top = stretched_height(heights, n, factor);
        const double change = (top.height - height) / top.slope;
        if (!(change > 1e-14)) return factor;
        factor -= change;
    }
}

}  // namespace

void stretch_heights(const Stretch& stretch, std::span<double> heights) {
    if ((stretch.factor == 1 && stretch.change == 1) || heights.size() <= stretch.above) return;
    double height_below = heights[stretch.above], height = height_below, product = 1, factor = stretch.factor;
    for (double& h : heights.subspan(stretch.above + std::size_t{1})) {
        product *= factor;
        factor *= stretch.change;
        height += product * (h - height_below);
        height_below = h;
        h = height;
    }
}

std::uint32_t layers_up_to(double height, std::span<const double> heights) {
    // Either the layers that fit as they are grow towards the height, or one more fits if they shrink by less.
    const auto first_above = std::upper_bound(heights.begin(), heights.end(), height);
    const auto fitting = static_cast<std::uint32_t>(first_above - heights.begin()) - 1;
    if (fitting == 0 || heights[fitting] == height || fitting + std::size_t{1} == heights.size()) return fitting;
    const double grown = factor_to_height(height, heights, fitting);
    return stretched_height(heights, fitting + 1, 1 / grown).height > height ? fitting : fitting + 1;
}

LayerRange layer_range(double height, std::span<const double> heights, std::uint32_t wanted) {
    const auto ends_there = [&](std::uint32_t n) {
        return stretched_height(heights, n, 1 / max_stretch).height <= height &&
               stretched_height(heights, n, max_stretch).height >= height;
    };
    LayerRange range{wanted, wanted};
    while (range.least > 1 && ends_there(range.least - 1)) --range.least;
    while (range.most + std::size_t{1} < heights.size() && ends_there(range.most + 1)) ++range.most;
    return range;
}

Stretch stretch_of_layers(double height, std::span<const double> heights, std::uint32_t n) {
    if (n < 2 || heights[n] == height) return {};
    return {factor_to_height(height, heights, n), 1, last_unstretched(n)};
}

double stretched_last_spacing(double height, std::span<const double> heights, std::uint32_t n) {
    if (n == 0) return 0;
    const Stretch stretch = stretch_of_layers(height, heights, n);
    double spacing = heights[n] - heights[n - 1];
    for (std::uint32_t k = stretch.above; stretch.factor != 1 && k < n; ++k) spacing *= stretch.factor;
    return spacing;
}

// Columns at sharp edges and bases are narrow up to the front, where triangles begin that are as small as columns are
// wide. Numbers of layers change little there (numbers.cpp), so that last layers are higher than columns are
// wide. They are made lower at the expense of those in the middle of the column:
//
//      |___|        |___|  <- front, as before
//      |   |        |___|
//      |   |        |   |
//      |___|        |___|      Left: layers of equal heights. Right: the last one has half of its height, and those
//      |   |        |   |      in the middle are a sixth higher. The number of layers is the same, and so is the front.
//      |   |        |   |
//      |___|        |   |
//      |   |        |___|
//
// The stretch of the column gets a second number, so that its end and its last spacing are both met. Where columns are
// far wider than their last layers are high, these become higher. Source: M. Vinokur, J. Comput. Phys. 50 (1983):
// stretching functions with prescribed spacings at both ends. docs/layer.md.

namespace {

/// Returns the layer above which the heights of a column with n layers may change.
std::uint32_t fixed_layers(const HeightColumn& column, std::uint32_t n) {
    return column.stretch.above > 0 ? column.stretch.above : last_unstretched(n);
}

/// Returns the least ratio of a last layer of this height, as a share of the part that changes: with a smaller one the
/// layer below would be more than three times as high.
double least_ratio(double last) { return last * (2 - last); }

/// The ratio to which the last spacing of a ray should be changed, and to which it may be: logarithms.
struct LogRatios {
    double part = 0;                 ///< length of the part of the column that changes
    double wanted = -HUGE_VAL;       ///< with it the last layer is about as high as the triangles beyond ask
    double most = HUGE_VAL;          ///< above it the last layer would be too high for them
    double lowest = 0, highest = 0;  ///< what the column has room for, whatever its neighbours want
};

/// Returns the height along a ray up to which a layer with this edge at its end has the area of a square on the edge.
/// It is the length of the edge, and more where the ray leans:
///
///        ._______.
///       /       /      edge * edge = height * (distance of the edge's other end from the ray)
///      /_______/
double height_of_square(Point edge, Point direction) {
    const double width = length(edge);
    const double across = std::max(std::abs(cross(edge, direction)), least_sine * width);
    return across > 0 ? width * width / across : 0;
}

/// Returns the ratios for a ray between these two others.
LogRatios log_ratios(const LayeredRays& rays, std::size_t before, std::size_t ray, std::size_t after, bool quads) {
    const std::uint32_t n = rays.counts[ray];
    const std::uint32_t fixed = fixed_layers(rays.heights.column(ray), n);
    if (n <= fixed || std::min(rays.counts[before], rays.counts[after]) == 0) return {};
    const std::span<const double> heights = rays.heights.of(ray);
    const double last = rays.last_spacing(ray), part = heights[n] - heights[fixed];
    const Point tip = rays.tip(ray), direction = rays.set.lines[ray].direction;
    const double square = std::sqrt(height_of_square(rays.tip(before) - tip, direction) *
                                    height_of_square(rays.tip(after) - tip, direction));
    if (last > max_last_share * part || !(square > 0)) return {};
    const double to_square = core::log_reproducible(square / last),
                 least = core::log_reproducible(quads ? least_tallness_of_quads : wanted_tallness) + to_square,
                 most = core::log_reproducible(wanted_tallness) + to_square;
    return {.part = part,
            .wanted = std::clamp(0.0, least, most),
            .most = to_square,
            .lowest = core::log_reproducible(least_ratio(last / part)),
            .highest = core::log_reproducible(std::min(max_end_ratio, max_last_share * part / last))};
}

/// Returns the ratio of each ray. quads: whether cells are quadrilaterals.
std::vector<double> end_ratios(const LayeredRays& rays, bool quads) {
    const RayNeighbours neighbours(rays.set);
    std::vector<LogRatios> bounds;
    for (std::size_t i = 0; i < rays.counts.size(); ++i)
        bounds.push_back(log_ratios(rays, neighbours.previous[i], i, neighbours.next[i], quads));
    std::vector<double> ratios(bounds.size());
    const auto lead_over = [&] {
        lower_to_neighbours(rays.set, ratios, [&](std::size_t from, std::size_t to) {
            const double part = std::max(bounds[from].part, bounds[to].part);
            return part > 0 ? ratios[from] + distance(rays.tip(from), rays.tip(to)) / part : HUGE_VAL;
        });
    };
    // Ratios first rise towards those of the neighbours, then fall: high last layers may not make cells of narrow
    // columns beside too high.
    for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] = -std::min(bounds[i].wanted, bounds[i].highest);
    lead_over();
    for (std::size_t i = 0; i < ratios.size(); ++i)
        ratios[i] = bounds[i].part > 0 ? std::min(-ratios[i], bounds[i].most) : HUGE_VAL;
    lead_over();
    for (std::size_t i = 0; i < ratios.size(); ++i)
        ratios[i] = core::exp_reproducible(
            std::clamp(ratios[i], bounds[i].lowest, std::max(bounds[i].lowest, bounds[i].highest)));
    return ratios;
}

/// Returns heights of which the last layer of each column, up to its number of layers, has this ratio to what it was.
LayerHeights with_end_ratios(const LayerHeights& heights, std::span<const std::uint32_t> counts,
                             std::span<const double> ratios) {
    std::vector<double> table = heights.table();
    std::vector<HeightColumn> columns;
    columns.reserve(ratios.size());
    for (std::size_t ray = 0; ray < ratios.size(); ++ray) {
        HeightColumn& column = columns.emplace_back(heights.column(ray));
        if (ratios[ray] == 1) continue;
        const std::span<double> of_ray = std::span(table).subspan(column.first, counts[ray] + std::size_t{1});
        const Stretch stretch = stretch_to_last_spacing(ratios[ray], of_ray, fixed_layers(column, counts[ray]));
        const double end = of_ray.back();
        stretch_heights(stretch, of_ray);
        of_ray.back() = end;  // rounding moves no front
        column.stretch = {column.stretch.factor * stretch.factor, stretch.change, stretch.above};
    }
    return LayerHeights(std::move(table), std::move(columns));
}

/// Returns whether a cell between two rays is crossed.
bool has_crossed_cell(const LayeredRays& rays, std::size_t i, std::size_t j) {
    const std::uint32_t common = std::min(rays.counts[i], rays.counts[j]);
    for (std::uint32_t n = 2; n <= common; ++n) {
        const Point a = rays.point(i, n - 1), b = rays.point(i, n), c = rays.point(j, n), d = rays.point(j, n - 1);
        if (!core::is_convex(a, b, c, d)) return true;
    }
    if (common == 0 || rays.counts[i] == rays.counts[j]) return false;
    const Point top = rays.point(rays.counts[i] > common ? i : j, common + 1);
    return !(core::inline_orient2d(rays.point(i, common), top, rays.point(j, common)) > 0);
}

/// Leaves the columns on both sides of crossed cells as they were: rows rise most where a column is narrower than at
/// the front. Columns as they were have no such cells. Returns whether there were any. It is a safety net for steep
/// fronts, which EndSpacings.CrossesNoCells holds.
bool leave_crossed_columns(const LayeredRays& rays, std::vector<double>& ratios) {
    const std::vector<std::size_t> next = rays.set.following();
    std::vector<std::size_t> crossed;
    for (std::size_t i = 0; i < next.size(); ++i)
        if ((ratios[i] != 1 || ratios[next[i]] != 1) && has_crossed_cell(rays, i, next[i])) crossed.push_back(i);
    for (const std::size_t i : crossed) ratios[i] = ratios[next[i]] = 1;
    return !crossed.empty();
}

}  // namespace

// With the last ratio e^c given, the ratio of a layer at the share x of the stretched part is exp(a (x - x^2) + c x^2):
// a product of factors that change by one more factor from layer to layer. The end of the column rises with a, and ever
// faster, so that Newton's method ends.
Stretch stretch_to_last_spacing(double ratio, std::span<const double> heights, std::uint32_t above) {
    constexpr int max_steps = 40;
    const auto layers = static_cast<double>(heights.size() - 1 - above);
    const double c = core::log_reproducible(ratio);
    Stretch stretch{1, 1, above};
    double a = c;
    for (int step = 0; step < max_steps; ++step) {
        stretch.factor = core::exp_reproducible((a + (c - a) / layers) / layers);
        stretch.change = core::exp_reproducible(2 * (c - a) / (layers * layers));
        double change_of_end = 0, slope = 0, product = 1, factor = stretch.factor;
        for (std::size_t n = above + std::size_t{1}; n < heights.size(); ++n) {
            product *= factor;
            factor *= stretch.change;
            const double x = static_cast<double>(n - above) / layers, spacing = heights[n] - heights[n - 1];
            change_of_end += (product - 1) * spacing;
            slope += product * spacing * x * (1 - x);
        }
        const double change = std::clamp(change_of_end / slope, -1.0, 1.0);
        if (std::abs(change) < 1e-13) break;
        a -= change;
    }
    return stretch;
}

void fit_end_spacings(Rays& rays) {
    if (rays.growth.layers || !uses("end_spacings")) return;
    const LayerHeights before = rays.heights;
    std::vector<double> ratios = end_ratios(layered_rays(rays), rays.topology == LayerTopology::quads);
    do {
        rays.heights = with_end_ratios(before, rays.counts, ratios);
    } while (leave_crossed_columns(layered_rays(rays), ratios));
}

}  // namespace lamina::layers
