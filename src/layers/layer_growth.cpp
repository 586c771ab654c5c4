// The growth of layers that follows from the options: the first height, and what growth laws make of their numbers.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <lamina/layers.hpp>
#include <lamina/option_builders.hpp>

#include "core/reproducible_math.hpp"
#include "layers/growth_laws.hpp"

namespace lamina {

using namespace layers;

double first_height_for(double y_plus, double reynolds, double chord) {
    require_in_range(positive_numbers, y_plus, "y_plus");
    require_in_range(positive_numbers, reynolds, "reynolds");
    require_in_range(positive_numbers, chord, "chord");
    const double friction = 0.026 / core::pow_reproducible(reynolds, 1.0 / 7);
    return y_plus * chord / (reynolds * std::sqrt(0.5 * friction));
}

LayerGrowth layer_growth(const LayerOptions& options, const ReferenceConditions& conditions,
                         std::vector<double> first_heights) {
    if (!options.enabled) return {};
    const double chord = conditions.chord;
    LayerGrowth growth{.law = options.growth_law,
                       .growth = options.growth,
                       .layers = options.layers,
                       .first_heights = std::move(first_heights)};
    if (options.thickness) growth.thickness = in_units(*options.thickness, chord);
    if (const auto* height = std::get_if<Length>(&options.first_height)) {
        growth.first_height = in_units(*height, chord);
    } else {
        if (!conditions.reynolds) throw OptionError("y_plus", "needs reynolds, or velocity and viscosity");
        growth.first_height =
            first_height_for(std::get<YPlus>(options.first_height).y_plus, *conditions.reynolds, chord);
    }
    const double largest = largest_first_height(growth);
    if (growth.thickness && !(*growth.thickness >= largest))
        throw OptionError("thickness", fmt::format("{} is less than the first height {}", *growth.thickness, largest));
    const GrowthLawEntry& law = growth_law_entry(growth.law);
    if (law.fills_thickness && !(*growth.thickness > *growth.layers * largest))
        throw OptionError("thickness", fmt::format("{} is no more than {} layers of {}: {} growth has nothing to grow",
                                                   *growth.thickness, *growth.layers, largest, law.name));
    return growth;
}

double largest_first_height(const LayerGrowth& growth) {
    if (growth.first_heights.empty()) return growth.first_height;
    return *std::max_element(growth.first_heights.begin(), growth.first_heights.end());
}

LayerGrowth growth_on_element(const LayerGrowth& growth, std::size_t element) {
    LayerGrowth own{.law = growth.law,
                    .first_height = growth.first_height_on(element),
                    .growth = growth.growth,
                    .layers = growth.layers,
                    .thickness = growth.thickness,
                    .fineness = growth.fineness};
    for (const WallHeight& height : growth.least_heights)
        if (height.element == element) own.least_heights.push_back({0, height.at, height.height});
    return own;
}

double layer_height(const LayerGrowth& growth, std::uint32_t n) {
    const GrowthLawEntry& law = growth_law_entry(growth.law);
    return law.heights(growth.first_height, law.ray_growth(growth), n).back();
}

std::optional<double> requested_height(const LayerGrowth& growth) {
    if (!growth.layers || growth_law_entry(growth.law).by_spacing) return std::nullopt;
    return std::min(layer_height(growth, *growth.layers), growth.thickness.value_or(HUGE_VAL));
}

}  // namespace lamina
