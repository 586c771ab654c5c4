// Heights of layers on rays, by the growth law, up to the thickness or up to isotropy.
#include "layers/heights.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "layers/growth_laws.hpp"
#include "layers/isotropy.hpp"

namespace lamina::layers {

namespace {

/// Largest number of layers up to isotropy; a growth that needs more is refused as a mistake.
constexpr std::uint32_t max_automatic_layers = 1000;

/// Removes the layers above `thickness`. A slack of rounding keeps all n layers of a thickness that is exactly their
/// height.
void cut_at_thickness(double thickness, std::vector<double>& heights) {
    heights.erase(std::upper_bound(heights.begin(), heights.end(), thickness * (1 + 1e-12)), heights.end());
}

std::uint32_t layer_count(const std::vector<double>& heights) { return static_cast<std::uint32_t>(heights.size() - 1); }

/// Returns columns that all lie in one table and end where their ray reaches isotropy.
LayerHeights heights_up_to_isotropy(const RaySet& set, double ray_growth, std::vector<double> table) {
    const std::vector<std::uint32_t> layers = layers_up_to_isotropy(set, table);
    if (std::any_of(layers.begin(), layers.end(), [](auto n) { return n >= max_automatic_layers; }))
        throw OptionError("layers", fmt::format("more than {} layers up to isotropy: give a larger growth, a thickness "
                                                "or their number",
                                                max_automatic_layers));
    std::vector<HeightColumn> columns;
    columns.reserve(layers.size());
    for (std::uint32_t n : layers) columns.push_back({0, n, ray_growth});
    return LayerHeights(std::move(table), std::move(columns));
}

/// Returns columns of which each has its own growth and its own part of the table.
LayerHeights heights_by_spacing(const RaySet& set, const LayerGrowth& growth, const GrowthLawEntry& law) {
    const std::vector<double> ray_growths = law.by_spacing->on_rays(set, growth);
    std::vector<double> table;
    std::vector<HeightColumn> columns;
    columns.reserve(ray_growths.size());
    for (double ray_growth : ray_growths) {
        std::vector<double> heights = law.heights(growth.first_height, ray_growth, *growth.layers);
        if (growth.thickness) cut_at_thickness(*growth.thickness, heights);
        columns.push_back({table.size(), layer_count(heights), ray_growth});
        table.insert(table.end(), heights.begin(), heights.end());
    }
    return LayerHeights(std::move(table), std::move(columns));
}

}  // namespace

double expected_height(const LayerGrowth& growth, double spacing) {
    const GrowthLawEntry& law = growth_law_entry(growth.law);
    const auto layers = growth.layers.value_or(max_automatic_layers);
    const double ray_growth = law.by_spacing ? law.by_spacing->expected(growth, spacing) : law.ray_growth(growth);
    const std::vector<double> heights = law.heights(growth.first_height, ray_growth, layers);
    std::size_t n = heights.size() - 1;
    if (!growth.layers)
        for (n = 1; n < layers && heights[n] - heights[n - 1] < spacing;) ++n;
    return std::min(heights[n], growth.thickness.value_or(HUGE_VAL));
}

LayerHeights make_heights(const RaySet& set, const LayerGrowth& growth) {
    const GrowthLawEntry& law = growth_law_entry(growth.law);
    if (law.by_spacing) return heights_by_spacing(set, growth, law);
    const double ray_growth = law.ray_growth(growth);
    std::vector<double> table =
        law.heights(growth.first_height, ray_growth, growth.layers.value_or(max_automatic_layers));
    if (growth.thickness && !law.fills_thickness) cut_at_thickness(*growth.thickness, table);
    if (!growth.layers) return heights_up_to_isotropy(set, ray_growth, std::move(table));
    const HeightColumn all{0, layer_count(table), ray_growth};
    return LayerHeights(std::move(table), std::vector<HeightColumn>(set.lines.size(), all));
}

}  // namespace lamina::layers

namespace lamina {

double LayerHeights::max_height() const {
    double highest = 0;
    for (std::size_t i = 0; i < columns_.size(); ++i) highest = std::max(highest, full_height(i));
    return highest;
}

}  // namespace lamina
