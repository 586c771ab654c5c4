// The formulas of the growth laws, and the table that names them. Sources: R. V. Garimella, M. S. Shephard, Boundary
// layer mesh generation for viscous flow simulations, Int. J. Numer. Meth. Engng 49 (2000); J. K. Pardue, thesis
// (2015), section 3.3.
#include "layers/growth_laws.hpp"

#include <algorithm>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "layers/heights/isotropy.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// H(n) = h (r^n - 1) / (r - 1), summed spacing by spacing.
std::vector<double> geometric_heights(double first_height, double ratio, std::uint32_t layers) {
    std::vector<double> heights{0.0};
    heights.reserve(layers + std::size_t{1});
    for (double spacing = first_height; heights.size() <= layers; spacing *= ratio)
        heights.push_back(heights.back() + spacing);
    return heights;
}

/// H(n) = h n^r.
std::vector<double> polynomial_heights(double first_height, double power, std::uint32_t layers) {
    std::vector<double> heights{0.0};
    heights.reserve(layers + std::size_t{1});
    for (std::uint32_t n = 1; n <= layers; ++n) heights.push_back(first_height * core::pow_reproducible(n, power));
    return heights;
}

/// Five equal spacings; each one after that is 1.05, 1.05^2, ... 1.5, 1.5 ... times the one below.
std::vector<double> aflr_heights(double first_height, double, std::uint32_t layers) {
    constexpr std::uint32_t equal_layers = 5;
    constexpr double acceleration = 1.05, max_ratio = 1.5;
    std::vector<double> heights{0.0};
    heights.reserve(layers + std::size_t{1});
    double spacing = first_height, ratio = 1;
    for (std::uint32_t n = 1; n <= layers; ++n) {
        if (n > equal_layers) {
            ratio = std::min(acceleration * ratio, max_ratio);
            spacing *= ratio;
        }
        heights.push_back(heights.back() + spacing);
    }
    return heights;
}

double given_growth(const LayerGrowth& growth) { return growth.growth; }

/// Returns the ratio with which all layers together are as high as the thickness. The exponential law is the geometric
/// one with r = e^(a/N): T (r^n - 1) / (r^N - 1) = h (r^n - 1) / (r - 1), where H(1) = h.
double ratio_for_thickness(const LayerGrowth& growth) {
    const double first_height = growth.first_height, thickness = *growth.thickness;
    double low = 1, high = thickness / first_height;
    for (;;) {
        const double ratio = 0.5 * (low + high);
        if (ratio == low || ratio == high) return low;
        (geometric_heights(first_height, ratio, *growth.layers).back() <= thickness ? low : high) = ratio;
    }
}

std::vector<double> adaptive_ratios(const RaySet& set, const LayerGrowth& growth) {
    return ratios_to_isotropy(set, growth.first_height, *growth.layers);
}

double expected_adaptive_ratio(const LayerGrowth& growth, double spacing) {
    if (*growth.layers < 2) return growth.growth;  // no ratio matters
    return std::clamp(core::pow_reproducible(spacing / growth.first_height, 1.0 / (*growth.layers - 1)),
                      min_adaptive_ratio, max_adaptive_ratio);
}

constexpr GrowthBySpacing adaptive_growth{.min_growth = min_adaptive_ratio,
                                          .max_growth = max_adaptive_ratio,
                                          .on_rays = adaptive_ratios,
                                          .expected = expected_adaptive_ratio};

constexpr GrowthLawEntry growth_laws[] = {
    {.law = GrowthLaw::geometric,
     .name = "geometric",
     .formula = "H (R^n - 1) / (R - 1)",
     .heights = geometric_heights,
     .ray_growth = given_growth},
    {.law = GrowthLaw::polynomial,
     .name = "polynomial",
     .formula = "H n^R",
     .heights = polynomial_heights,
     .ray_growth = given_growth},
    {.law = GrowthLaw::exponential,
     .name = "exponential",
     .formula = "T (e^(a n/N) - 1) / (e^a - 1), where a makes the first layer H high",
     .heights = geometric_heights,
     .ray_growth = ratio_for_thickness,
     .min_layers = 2,
     .fills_thickness = true},
    {.law = GrowthLaw::adaptive,
     .name = "adaptive",
     .formula = "geometric, where a ratio of 1.05 to 1.5 makes the last layer as high as the rays stand apart",
     .heights = geometric_heights,
     .ray_growth = given_growth,
     .by_spacing = &adaptive_growth,
     .min_layers = 1},
    {.law = GrowthLaw::aflr,
     .name = "aflr",
     .formula = "5 layers of H, then each 1.05, 1.05^2, ... 1.5, 1.5 ... times as high as the one below",
     .heights = aflr_heights,
     .ray_growth = given_growth},
};

}  // namespace

std::span<const GrowthLawEntry> growth_law_table() { return growth_laws; }

const GrowthLawEntry& growth_law_entry(GrowthLaw law) {
    for (const GrowthLawEntry& entry : growth_laws)
        if (entry.law == law) return entry;
    throw OptionError("growth_law", "is not known");
}

}  // namespace lamina::layers
