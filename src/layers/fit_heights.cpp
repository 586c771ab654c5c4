// Stacks that end where the space for them does. Layers of fixed heights under a limit that varies along the wall end
// in steps of a whole layer, a fifth of the height at a growth of 1.2 (above: the limit; below: where the layers end):
//
//          . - - - .                        . - - - .
//       .     ___     .                  . /         \ .
//     .   ___|   |___   .              . /             \ .
//   .  __|           |__  .          . /                 \ .
//          fixed                              fitted
//
// A growth some per mille off, the less the more layers, makes the difference.
#include <algorithm>
#include <vector>

#include "core/parallel.hpp"
#include "layers/heights.hpp"

namespace lamina::layers {
namespace {

/// Height of layer n of a stack, stretched.
double stretched_height(std::span<const double> heights, std::uint32_t n, double stretch) {
    double height = 0, factor = 1;
    for (std::uint32_t k = 0; k < n; ++k) {
        height += factor * (heights[k + 1] - heights[k]);
        factor *= stretch;
    }
    return height;
}

/// The largest stretch with which layer n is not above the limit, between the bounds; the lower bound if none.
double largest_fit(std::span<const double> heights, std::uint32_t n, double limit) {
    double low = 1 / max_stretch, high = max_stretch;
    if (stretched_height(heights, n, high) <= limit) return high;
    for (int step = 0; step < 48; ++step) {
        const double middle = 0.5 * (low + high);
        (stretched_height(heights, n, middle) <= limit ? low : high) = middle;
    }
    return low;
}

/// As few per mille as possible: either the layers that fit as they are grow towards the limit, or they shrink for one
/// more to fit.
double fit(std::span<const double> heights, double limit) {
    const auto above = std::upper_bound(heights.begin(), heights.end(), limit);
    const auto fitting = static_cast<std::uint32_t>(above - heights.begin()) - 1;
    if (fitting == 0) return 1;
    const double grown = largest_fit(heights, fitting, limit), shrunk = largest_fit(heights, fitting + 1, limit);
    const bool one_more = stretched_height(heights, fitting + 1, shrunk) <= limit;
    const bool shrunk_less = grown == max_stretch || grown * shrunk > 1;
    return one_more && shrunk_less ? shrunk : grown;
}

}  // namespace

void stretch_heights(double stretch, std::span<double> heights) {
    double below = heights[0], height = 0, factor = 1;
    for (double& h : heights.subspan(1)) {
        height += factor * (h - below);
        factor *= stretch;
        below = h;
        h = height;
    }
}

LayerHeights fit_heights(const LayerHeights& heights, std::span<const double> limits) {
    std::vector<HeightColumn> columns(limits.size());
    core::parallel_for(limits.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            columns[i] = heights.column(i);
            if (limits[i] < heights.full_height(i)) columns[i].stretch = fit(heights.of(i), limits[i]);
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
