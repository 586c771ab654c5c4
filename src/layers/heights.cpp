// Growth laws. Sources: R. V. Garimella, M. S. Shephard, Boundary layer mesh generation for viscous flow simulations,
// Int. J. Numer. Meth. Engng 49 (2000); J. K. Pardue, thesis (2015), section 3.3.
#include "layers/heights.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "layers/isotropy.hpp"

namespace lamina::layers {

namespace {

/// More layers than these up to isotropy are not what anybody wants.
constexpr std::uint32_t max_automatic_layers = 1000;

std::vector<double> geometric_heights(double first_height, double ratio, std::uint32_t layers) {
    std::vector<double> heights{0.0};
    for (double step = first_height; heights.size() <= layers; step *= ratio) heights.push_back(heights.back() + step);
    return heights;
}

std::vector<double> polynomial_heights(double first_height, double power, std::uint32_t layers) {
    std::vector<double> heights{0.0};
    for (std::uint32_t n = 1; n <= layers; ++n) heights.push_back(first_height * core::pow_reproducible(n, power));
    return heights;
}

std::vector<double> aflr_heights(double first_height, std::uint32_t layers) {
    constexpr std::uint32_t equal_layers = 5;
    constexpr double acceleration = 1.05, largest_ratio = 1.5;
    std::vector<double> heights{0.0};
    double step = first_height, ratio = 1;
    for (std::uint32_t n = 1; n <= layers; ++n) {
        if (n > equal_layers) {
            ratio = std::min(acceleration * ratio, largest_ratio);
            step *= ratio;
        }
        heights.push_back(heights.back() + step);
    }
    return heights;
}

/// The ratio with which `layers` layers are `thickness` high. The exponential law is the geometric one with
/// r = e^(a/N): T (r^n - 1) / (r^N - 1) = h (r^n - 1) / (r - 1), where H(1) = h.
double ratio_for_thickness(double first_height, std::uint32_t layers, double thickness) {
    double low = 1, high = thickness / first_height;
    for (;;) {
        const double ratio = 0.5 * (low + high);
        if (ratio == low || ratio == high) return low;
        (geometric_heights(first_height, ratio, layers).back() <= thickness ? low : high) = ratio;
    }
}

/// Takes away the layers above `thickness`, with a slack of rounding: a thickness of exactly n layers gives n.
void cut(double thickness, std::vector<double>& heights) {
    heights.erase(std::upper_bound(heights.begin(), heights.end(), thickness * (1 + 1e-12)), heights.end());
}

std::uint32_t layers_of(const std::vector<double>& heights) { return static_cast<std::uint32_t>(heights.size() - 1); }

LayerHeights heights_up_to_isotropy(const RaySet& set, const LayerGrowth& growth, std::vector<double> table) {
    const std::vector<std::uint32_t> layers = layers_up_to_isotropy(set, table);
    if (std::any_of(layers.begin(), layers.end(), [](auto n) { return n >= max_automatic_layers; }))
        throw OptionError("layers", fmt::format("more than {} layers up to isotropy: give a larger growth, a thickness "
                                                "or their number",
                                                max_automatic_layers));
    std::vector<HeightColumn> columns;
    for (std::uint32_t n : layers) columns.push_back({0, n, growth.growth});
    return LayerHeights(std::move(table), std::move(columns));
}

LayerHeights adaptive_heights(const RaySet& set, const LayerGrowth& growth) {
    const std::vector<double> ratios = ratios_to_isotropy(set, growth.first_height, *growth.layers);
    std::vector<double> table;
    std::vector<HeightColumn> columns;
    for (double ratio : ratios) {
        std::vector<double> heights = geometric_heights(growth.first_height, ratio, *growth.layers);
        if (growth.thickness) cut(*growth.thickness, heights);
        columns.push_back({table.size(), layers_of(heights), ratio});
        table.insert(table.end(), heights.begin(), heights.end());
    }
    return LayerHeights(std::move(table), std::move(columns));
}

}  // namespace

double common_growth(const LayerGrowth& growth) {
    return growth.law == GrowthLaw::exponential
               ? ratio_for_thickness(growth.first_height, *growth.layers, *growth.thickness)
               : growth.growth;
}

std::vector<double> heights_by_law(GrowthLaw law, double first_height, double growth, std::uint32_t layers) {
    if (law == GrowthLaw::polynomial) return polynomial_heights(first_height, growth, layers);
    if (law == GrowthLaw::aflr) return aflr_heights(first_height, layers);
    return geometric_heights(first_height, growth, layers);
}

double expected_height(const LayerGrowth& growth, double spacing) {
    const auto layers = growth.layers.value_or(max_automatic_layers);
    double ratio = common_growth(growth);
    if (growth.law == GrowthLaw::adaptive && layers > 1)
        ratio = std::clamp(core::pow_reproducible(spacing / growth.first_height, 1.0 / (layers - 1)),
                           smallest_adaptive_ratio, largest_adaptive_ratio);
    const std::vector<double> heights = heights_by_law(growth.law, growth.first_height, ratio, layers);
    std::size_t n = heights.size() - 1;
    if (!growth.layers)
        for (n = 1; n < layers && heights[n] - heights[n - 1] < spacing;) ++n;
    return std::min(heights[n], growth.thickness.value_or(HUGE_VAL));
}

LayerHeights make_heights(const RaySet& set, const LayerGrowth& growth) {
    if (growth.law == GrowthLaw::adaptive) return adaptive_heights(set, growth);
    const double ratio = common_growth(growth);
    std::vector<double> table =
        heights_by_law(growth.law, growth.first_height, ratio, growth.layers.value_or(max_automatic_layers));
    // The exponential law meets its thickness itself.
    if (growth.thickness && growth.law != GrowthLaw::exponential) cut(*growth.thickness, table);
    if (!growth.layers) return heights_up_to_isotropy(set, growth, std::move(table));
    const HeightColumn all{0, layers_of(table), ratio};
    return LayerHeights(std::move(table), std::vector<HeightColumn>(set.lines.size(), all));
}

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

double LayerHeights::max_height() const {
    double tallest = 0;
    for (std::size_t i = 0; i < columns_.size(); ++i) tallest = std::max(tallest, full_height(i));
    return tallest;
}

double layer_height(const LayerGrowth& growth, std::uint32_t n) {
    return heights_by_law(growth.law, growth.first_height, common_growth(growth), n).back();
}

}  // namespace lamina
