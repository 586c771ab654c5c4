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
// differs in the upper half of the layers alone. Cells near the wall are a thousand times as long as high, so where their
// ends differ in height by one more per mille from row to row, the middles of neighbouring rows shift against each other
// by more than the rows are high, and faces are far from orthogonal:
//
//      _________________              _________________
//     |_________________|            |_________________|        Left: rows whose ends differ by more from row to row.
//     |_____.-----------|            |_________________|        Right: rows that differ alike, as rows of the same
//     |-----____________|            |_________________|        heights do everywhere.
#include "layers/heights/stretch.hpp"

#include <algorithm>
#include <cmath>

#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// Returns the height of the topmost of n layers if they are stretched.
double stretched_height(std::span<const double> heights, std::uint32_t n, double factor) {
    const std::uint32_t kept = std::min(last_unstretched(n), n);
    double height = heights[kept], product = 1;
    for (std::uint32_t k = kept; k < n; ++k) {
        product *= factor;
        height += product * (heights[k + 1] - heights[k]);
    }
    return height;
}

/// Returns the factor with which layer n ends at the height, to some 1e-15, by Newton's method from a factor that is too
/// large: the height is a polynomial of the factor with positive coefficients, so no step goes too far. Returns NaN
/// where eight steps are not enough.
double factor_near(double height, std::span<const double> heights, std::uint32_t n, double factor) {
    const std::uint32_t kept = std::min(last_unstretched(n), n);
    for (int step = 0; step < 8; ++step) {
        double reached = heights[kept], slope = 0, product = 1;
        for (std::uint32_t k = kept; k < n; ++k) {
            const double thickness = heights[k + 1] - heights[k];
            slope += (k - kept + 1) * product * thickness;
            product *= factor;
            reached += product * thickness;
        }
        const double change = (reached - height) / slope;
        factor -= change;
        if (std::abs(change) < 1e-12) return factor;
    }
    return NAN;
}

/// Returns the largest factor up to max_stretch with which layer n ends at or below the height; 1 / max_stretch if there
/// is none.
double max_factor_below(double height, std::span<const double> heights, std::uint32_t n) {
    double low = 1 / max_stretch, high = max_stretch;
    if (stretched_height(heights, n, high) <= height) return high;
    const double near = factor_near(height, heights, n, high);
    for (int halving = 0; halving < 48; ++halving) {
        const double middle = 0.5 * (low + high);
        const bool is_clear = std::abs(middle - near) > 1e-13;  // a hundred times what rounding does to either
        const bool fits = is_clear ? middle < near : stretched_height(heights, n, middle) <= height;
        (fits ? low : high) = middle;
    }
    return low;
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

StretchedLayers layers_up_to(double height, std::span<const double> heights) {
    // Either the layers that fit as they are grow towards the height, or they shrink until one more fits.
    const auto first_above = std::upper_bound(heights.begin(), heights.end(), height);
    const auto fitting = static_cast<std::uint32_t>(first_above - heights.begin()) - 1;
    if (fitting == 0 || heights[fitting] == height) return {fitting, {}};
    const double grown = max_factor_below(height, heights, fitting);
    const StretchedLayers as_many{fitting, {grown, 1, last_unstretched(fitting)}};
    if (fitting + std::size_t{1} == heights.size()) return as_many;
    // One more layer fits if it shrinks by the largest factor, and is taken if it shrinks by less than the others grow.
    const double least = grown == max_stretch ? 1 / max_stretch : 1 / grown;
    if (stretched_height(heights, fitting + 1, least) > height) return as_many;
    return {fitting + 1, {max_factor_below(height, heights, fitting + 1), 1, last_unstretched(fitting + 1)}};
}

LayerRange layer_range(double height, std::span<const double> heights, std::uint32_t wanted) {
    const auto ends_there = [&](std::uint32_t n) {
        return stretched_height(heights, n, 1 / max_stretch) <= height &&
               stretched_height(heights, n, max_stretch) >= height;
    };
    LayerRange range{wanted, wanted};
    while (range.least > 1 && ends_there(range.least - 1)) --range.least;
    while (range.most + std::size_t{1} < heights.size() && ends_there(range.most + 1)) ++range.most;
    return range;
}

Stretch stretch_of_layers(double height, std::span<const double> heights, std::uint32_t n) {
    if (n < 2 || heights[n] == height) return {};
    return {max_factor_below(height, heights, n), 1, last_unstretched(n)};
}

double stretched_last_spacing(double height, std::span<const double> heights, std::uint32_t n) {
    if (n == 0) return 0;
    const Stretch stretch = stretch_of_layers(height, heights, n);
    double spacing = heights[n] - heights[n - 1];
    for (std::uint32_t k = stretch.above; stretch.factor != 1 && k < n; ++k) spacing *= stretch.factor;
    return spacing;
}

}  // namespace lamina::layers
