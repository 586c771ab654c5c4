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

/// Returns the largest stretch from 1 / max_stretch to max_stretch with which layer n ends at or below the limit;
/// 1 / max_stretch if there is none.
double max_stretch_below(double limit, std::span<const double> heights, std::uint32_t n) {
    double low = 1 / max_stretch, high = max_stretch;
    if (stretched_height(heights, n, high) <= limit) return high;
    for (int halving = 0; halving < 48; ++halving) {
        const double middle = 0.5 * (low + high);
        (stretched_height(heights, n, middle) <= limit ? low : high) = middle;
    }
    return low;
}

/// Returns the stretch nearer to 1 of two: either the layers that fit as they are grow towards the limit, or they
/// shrink until one more fits.
double stretch_to(double limit, std::span<const double> heights) {
    const auto first_above = std::upper_bound(heights.begin(), heights.end(), limit);
    const auto fitting = static_cast<std::uint32_t>(first_above - heights.begin()) - 1;
    if (fitting == 0) return 1;
    const double grown = max_stretch_below(limit, heights, fitting),
                 shrunk = max_stretch_below(limit, heights, fitting + 1);
    const bool one_more = stretched_height(heights, fitting + 1, shrunk) <= limit;
    const bool shrunk_less = grown == max_stretch || grown * shrunk > 1;
    return one_more && shrunk_less ? shrunk : grown;
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

LayerHeights fit_heights(const LayerHeights& heights, std::span<const double> limits) {
    std::vector<HeightColumn> columns(limits.size());
    core::parallel_for(limits.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            columns[i] = heights.column(i);
            if (limits[i] < heights.full_height(i)) columns[i].stretch = stretch_to(limits[i], heights.of(i));
        }
    });
    std::vector<double> table = heights.table();
    for (std::size_t i = 0; i < limits.size(); ++i) {
        if (columns[i].stretch == 1) continue;
        columns[i].first = table.size();
        const std::span<const double> fixed = heights.of(i);
        table.insert(table.end(), fixed.begin(), fixed.end());
        stretch_heights(columns[i].stretch, std::span(table).subspan(columns[i].first));
    }
    return LayerHeights(std::move(table), std::move(columns));
}

}  // namespace lamina::layers
