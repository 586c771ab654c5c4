// The growth of layers that follows from the options: the first height, and what growth laws make of their numbers.
#include <algorithm>
#include <cmath>

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

LayerGrowth layer_growth(const LayerOptions& options, const ReferenceConditions& conditions) {
    if (!options.enabled) return {};
    const double chord = conditions.chord;
    LayerGrowth growth{options.growth_law, 0, options.growth, options.layers, {}};
    if (options.thickness) growth.thickness = in_units(*options.thickness, chord);
    if (const auto* height = std::get_if<Length>(&options.first_height)) {
        growth.first_height = in_units(*height, chord);
    } else {
        if (!conditions.reynolds) throw OptionError("y_plus", "needs reynolds, or velocity and viscosity");
        growth.first_height =
            first_height_for(std::get<YPlus>(options.first_height).y_plus, *conditions.reynolds, chord);
    }
    if (growth.thickness && !(*growth.thickness >= growth.first_height))
        throw OptionError("thickness",
                          fmt::format("{} is less than the first height {}", *growth.thickness, growth.first_height));
    const GrowthLawEntry& law = growth_law_entry(growth.law);
    if (law.fills_thickness && !(*growth.thickness > *growth.layers * growth.first_height))
        throw OptionError("thickness", fmt::format("{} is no more than {} layers of {}: {} growth has nothing to grow",
                                                   *growth.thickness, *growth.layers, growth.first_height, law.name));
    return growth;
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
