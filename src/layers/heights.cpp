// Growth laws. Sources: R. V. Garimella, M. S. Shephard, Boundary layer mesh generation for viscous flow simulations,
// Int. J. Numer. Meth. Engng 49 (2000); J. K. Pardue, thesis (2015), section 3.3.
#include "layers/heights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "layers/isotropy.hpp"

namespace lamina {
namespace {

/// More layers than these up to isotropy are not what anybody wants.
constexpr std::uint32_t most_automatic_layers = 1000;

void require(bool condition, const std::string& message) {
    if (!condition) throw UsageError(message);
}

std::vector<double> geometric_heights(double first_height, double ratio, std::uint32_t layers) {
    std::vector<double> heights{0.0};
    for (double step = first_height; heights.size() <= layers; step *= ratio) heights.push_back(heights.back() + step);
    return heights;
}

std::vector<double> polynomial_heights(double first_height, double power, std::uint32_t layers) {
    std::vector<double> heights{0.0};
    for (std::uint32_t n = 1; n <= layers; ++n) heights.push_back(first_height * pow_reproducible(n, power));
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

Heights heights_up_to_isotropy(const RaySet& set, const LayerOptions& options, std::vector<double> table) {
    const std::vector<std::uint32_t> layers = layers_up_to_isotropy(set, table);
    const bool reached = std::all_of(layers.begin(), layers.end(), [](auto n) { return n < most_automatic_layers; });
    require(reached,
            fmt::format("more than {} layers up to isotropy: give a larger growth, a thickness or their number",
                        most_automatic_layers));
    std::vector<Stack> stacks;
    for (std::uint32_t n : layers) stacks.push_back({0, n, options.growth});
    return Heights(std::move(table), std::move(stacks));
}

Heights adaptive_heights(const RaySet& set, const LayerOptions& options) {
    const std::vector<double> ratios = ratios_to_isotropy(set, options.first_height, *options.layers);
    std::vector<double> table;
    std::vector<Stack> stacks;
    for (double ratio : ratios) {
        std::vector<double> heights = geometric_heights(options.first_height, ratio, *options.layers);
        if (options.thickness) cut(*options.thickness, heights);
        stacks.push_back({table.size(), layers_of(heights), ratio});
        table.insert(table.end(), heights.begin(), heights.end());
    }
    return Heights(std::move(table), std::move(stacks));
}

}  // namespace

double Heights::tallest() const {
    double tallest = 0;
    for (std::size_t i = 0; i < stacks_.size(); ++i) tallest = std::max(tallest, full(i));
    return tallest;
}

void check_growth(const LayerOptions& o) {
    require(o.first_height > 0 && std::isfinite(o.first_height),
            fmt::format("first height must be greater than 0, not {}", o.first_height));
    require(o.growth > 1 && std::isfinite(o.growth), fmt::format("growth must be greater than 1, not {}", o.growth));
    if (o.layers)
        require(*o.layers >= 1 && *o.layers <= std::numeric_limits<std::uint16_t>::max(),
                fmt::format("layers must be from 1 to 65535, not {}", *o.layers));
    if (o.thickness)
        require(
            *o.thickness >= o.first_height && std::isfinite(*o.thickness),
            fmt::format("layer thickness {} must not be less than the first height {}", *o.thickness, o.first_height));
    if (o.growth_law == GrowthLaw::adaptive)
        require(o.layers.has_value(), "adaptive growth needs a number of layers, not auto");
    if (o.growth_law == GrowthLaw::exponential) {
        require(o.layers && *o.layers >= 2 && o.thickness, "exponential growth needs a thickness and 2 layers or more");
        require(*o.thickness > *o.layers * o.first_height,
                fmt::format("exponential growth: {} layers of {} are no less than the thickness {}", *o.layers,
                            o.first_height, *o.thickness));
    }
}

double common_growth(const LayerOptions& options) {
    return options.growth_law == GrowthLaw::exponential
               ? ratio_for_thickness(options.first_height, *options.layers, *options.thickness)
               : options.growth;
}

std::vector<double> heights_by_law(GrowthLaw law, double first_height, double growth, std::uint32_t layers) {
    if (law == GrowthLaw::polynomial) return polynomial_heights(first_height, growth, layers);
    if (law == GrowthLaw::aflr) return aflr_heights(first_height, layers);
    return geometric_heights(first_height, growth, layers);
}

double expected_height(const LayerOptions& options, double spacing) {
    const auto layers = options.layers.value_or(most_automatic_layers);
    double growth = common_growth(options);
    if (options.growth_law == GrowthLaw::adaptive && layers > 1)
        growth = std::clamp(pow_reproducible(spacing / options.first_height, 1.0 / (layers - 1)),
                            smallest_adaptive_ratio, largest_adaptive_ratio);
    const std::vector<double> heights = heights_by_law(options.growth_law, options.first_height, growth, layers);
    std::size_t n = heights.size() - 1;
    if (!options.layers)
        for (n = 1; n < layers && heights[n] - heights[n - 1] < spacing;) ++n;
    return std::min(heights[n], options.thickness.value_or(HUGE_VAL));
}

Heights make_heights(const RaySet& set, const LayerOptions& options) {
    if (options.growth_law == GrowthLaw::adaptive) return adaptive_heights(set, options);
    const double growth = common_growth(options);
    std::vector<double> table = heights_by_law(options.growth_law, options.first_height, growth,
                                               options.layers.value_or(most_automatic_layers));
    // The exponential law meets its thickness itself.
    if (options.thickness && options.growth_law != GrowthLaw::exponential) cut(*options.thickness, table);
    if (!options.layers) return heights_up_to_isotropy(set, options, std::move(table));
    const Stack all{0, layers_of(table), growth};
    return Heights(std::move(table), std::vector<Stack>(set.rays.size(), all));
}

double first_height_for(double y_plus, double reynolds, double chord) {
    const auto demand = [](const char* name, double value) {
        require(value > 0 && std::isfinite(value), fmt::format("{} must be greater than 0, not {}", name, value));
    };
    demand("y+", y_plus);
    demand("the Reynolds number", reynolds);
    demand("the chord", chord);
    const double friction = 0.026 / pow_reproducible(reynolds, 1.0 / 7);
    return y_plus * chord / (reynolds * std::sqrt(0.5 * friction));
}

double layer_height(const LayerOptions& options, std::uint32_t n) {
    check_growth(options);
    return heights_by_law(options.growth_law, options.first_height, common_growth(options), n).back();
}

}  // namespace lamina
