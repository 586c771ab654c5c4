// Columns of heights that end where the space for them does. Layers of fixed heights under a limit that varies along
// the wall would end in steps of a whole layer, a fifth of the height at a growth of 1.2:
//
//          . - - - .                        . - - - .
//       .     ___     .                  . /         \ .           . .  limits of the rays
//     .   ___|   |___   .              . /             \ .         ___  ends of the layers
//   .  __|           |__  .          . /                 \ .
//         fixed heights                   fitted heights
//
// A growth that differs by some per mille, the less the more layers there are, makes a layer end at the limit.
#include "layers/fit_heights.hpp"

#include <algorithm>
#include <vector>

#include "core/parallel.hpp"

namespace lamina::layers {

namespace {

/// Returns the height of layer n of a column whose spacings are stretched.
double stretched_height(std::span<const double> heights, std::uint32_t n, double stretch) {
    double height = 0, factor = 1;
    for (std::uint32_t k = 0; k < n; ++k) {
        height += factor * (heights[k + 1] - heights[k]);
        factor *= stretch;
    }
    return height;
}

/// Bounds of a stretch.
struct StretchBounds {
    double low = 1 / max_stretch, high = max_stretch;
};

/// Returns the largest stretch within the bounds with which layer n ends at or below the height; the lower bound if
/// there is none.
double max_stretch_below(double height, std::span<const double> heights, std::uint32_t n, const StretchBounds& bounds) {
    double low = bounds.low, high = bounds.high;
    if (stretched_height(heights, n, high) <= height) return high;
    for (int halving = 0; halving < 48; ++halving) {
        const double middle = 0.5 * (low + high);
        (stretched_height(heights, n, middle) <= height ? low : high) = middle;
    }
    return low;
}

/// Returns the better of two: either the layers that fit as they are grow towards the height, or they shrink until one
/// more fits.
StretchedLayers layers_within(double height, std::span<const double> heights, const StretchBounds& bounds) {
    const auto first_above = std::upper_bound(heights.begin(), heights.end(), height);
    const auto fitting = static_cast<std::uint32_t>(first_above - heights.begin()) - 1;
    if (fitting == 0 || heights[fitting] == height) return {fitting, 1};
    const double grown = max_stretch_below(height, heights, fitting, bounds);
    if (fitting + std::size_t{1} == heights.size()) return {fitting, grown};
    const double shrunk = max_stretch_below(height, heights, fitting + 1, bounds);
    const bool one_more = stretched_height(heights, fitting + 1, shrunk) <= height;
    const bool shrunk_less = grown == bounds.high || grown * shrunk > 1;
    return one_more && shrunk_less ? StretchedLayers{fitting + 1, shrunk} : StretchedLayers{fitting, grown};
}

}  // namespace

void stretch_heights(double stretch, std::span<double> heights) {
    double height_below = heights[0], height = 0, factor = 1;
    for (double& h : heights.subspan(1)) {
        height += factor * (h - height_below);
        factor *= stretch;
        height_below = h;
        h = height;
    }
}

StretchedLayers layers_up_to(double height, std::span<const double> heights) {
    return layers_within(height, heights, {});
}

double stretch_of_layers(double height, std::span<const double> heights, std::uint32_t n) {
    if (n < 2 || heights[n] == height) return 1;
    return max_stretch_below(height, heights, n, {});
}

LayerHeights fit_heights(const LayerHeights& heights, std::span<const double> limits) {
    std::vector<HeightColumn> columns(limits.size());
    std::vector<double> extra(limits.size(), 1.0);  // stretch beside the one that a column has already
    core::parallel_for(limits.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            columns[i] = heights.column(i);
            if (limits[i] >= heights.full_height(i)) continue;
            const double own = columns[i].stretch;
            extra[i] = layers_within(limits[i], heights.of(i), {1 / (max_stretch * own), max_stretch / own}).stretch;
            columns[i].stretch = std::clamp(own * extra[i], 1 / max_stretch, max_stretch);
        }
    });
    std::vector<double> table = heights.table();
    for (std::size_t i = 0; i < limits.size(); ++i) {
        if (extra[i] == 1) continue;
        columns[i].first = table.size();
        const std::span<const double> fixed = heights.of(i);
        table.insert(table.end(), fixed.begin(), fixed.end());
        stretch_heights(extra[i], std::span(table).subspan(columns[i].first));
    }
    return LayerHeights(std::move(table), std::move(columns));
}

}  // namespace lamina::layers
