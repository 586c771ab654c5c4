// The growth laws with the table that names them, the growth that follows from the options of the layer, and the table
// of these. Sources: R. V. Garimella, M. S. Shephard, Boundary layer mesh generation for viscous flow simulations, Int.
// J. Numer. Meth. Engng 49 (2000); J. K. Pardue, thesis (2015), section 3.3.
#include "layers/growth_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/layers.hpp>

#include "core/option_rows.hpp"
#include "core/reproducible_math.hpp"
#include "layers/heights/isotropy.hpp"
#include "layers/layer.hpp"
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

constexpr GrowthBySpacing adaptive_growth{
    .min_growth = min_adaptive_ratio, .max_growth = max_adaptive_ratio, .on_rays = adaptive_ratios};

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

// The growth of layers that follows from the options: the first height, and what growth laws make of their numbers.

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
    for (const WallHeight& height : growth.wall_first_heights)
        if (height.element == element) own.wall_first_heights.push_back({0, height.at, height.height});
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

void validate(const BorderOptions& options) {
    require_in_range(numbers_above(1), options.max_ratio, "max_ratio");
    require_in_range(positive_numbers, options.gradation, "gradation");
    if (!(options.max_edge > 0)) throw OptionError("max_edge", "must be greater than 0");
}

namespace {

/// Adds the options of the first height: a length, or the y+ that it follows from. Each replaces the other.
void add_first_height(OptionTableBuilder<LayerOptions>& table) {
    const auto set_first_height = [](LayerOptions& options, const OptionValue& value) {
        const Length height = as_length(value, "first_height");
        require_in_range(positive_numbers, height.value, "first_height");
        options.first_height = height;
    };
    const auto get_first_height = [](const LayerOptions& options) -> std::optional<OptionValue> {
        const auto* height = std::get_if<Length>(&options.first_height);
        return height ? std::optional<OptionValue>(option_value(*height)) : std::nullopt;
    };
    table
        .add({"first-height", OptionKind::length, "H", "height of the first layer above the wall",
              positive_numbers.text(), set_first_height, get_first_height})
        .excludes = {"y-plus"};
    const auto set_y_plus = [](LayerOptions& options, const OptionValue& value) {
        const double y_plus = as_number(value, "y_plus");
        require_in_range(positive_numbers, y_plus, "y_plus");
        options.first_height = YPlus{y_plus};
    };
    const auto get_y_plus = [](const LayerOptions& options) -> std::optional<OptionValue> {
        const auto* flow = std::get_if<YPlus>(&options.first_height);
        return flow ? std::optional<OptionValue>(flow->y_plus) : std::nullopt;
    };
    table.add(
        {"y-plus", OptionKind::number, "Y",
         "instead: y+ of the top of the first layer, on a flat plate or, with use-flow, where friction is largest; "
         "needs reynolds, or velocity and viscosity",
         positive_numbers.text(), set_y_plus, get_y_plus});
}

/// Adds the option of the growth law, whose help lists the formulas.
void add_growth_law(OptionTableBuilder<LayerOptions>& table) {
    Choices<GrowthLaw> choices;
    std::string help = "height of the top of layer n, where H is the first height:";
    for (const GrowthLawEntry& law : growth_law_table()) {
        help += fmt::format("{} {}, {}", choices.empty() ? "" : ";", law.name, law.formula);
        choices.emplace_back(law.name, law.law);
    }
    table.choice("growth-law", help, choices, member_at(&LayerOptions::growth_law));
}

}  // namespace

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

template <>
OptionTable<LayerOptions> option_rows() {
    OptionTableBuilder<LayerOptions> table("Layer");
    const auto at = [](auto LayerOptions::*member) { return member_at(member); };
    add_first_height(table);
    table.number("growth", "R", "ratio of the heights of successive layers, or power of the polynomial law",
                 numbers_above(1), at(&LayerOptions::growth));
    add_growth_law(table);
    // Layer::layer_of_point has 16 bits.
    table.count_or_auto("layers", "N", "number of layers; auto: on each ray up to cells as high as wide",
                        numbers_from_to(1, std::numeric_limits<std::uint16_t>::max()), at(&LayerOptions::layers));
    table.length("thickness", "T", "total height beyond which no layer goes", positive_numbers,
                 at(&LayerOptions::thickness));
    table.flag("no-layers", "isotropic triangles up to the wall", false, at(&LayerOptions::enabled));
    table.number("max-ray-angle", "DEG", "largest angle by which neighbouring rays diverge, in degrees",
                 numbers_from_to(0.01, 90), at(&LayerOptions::max_ray_angle_deg));
    table.choice("corners", "at sharp convex corners: a fan of rays, or refining rays beside the vertex",
                 Choices<CornerRays>{{"fan", CornerRays::fan}, {"refine", CornerRays::refine}},
                 at(&LayerOptions::corners));
    table.choice("layer-topology",
                 "cells of the layer: Delaunay triangles, or the grid of rays and layers, cut or left whole",
                 Choices<LayerTopology>{{"delaunay", LayerTopology::delaunay},
                                        {"layered", LayerTopology::layered},
                                        {"quads", LayerTopology::quads}},
                 at(&LayerOptions::topology));
    table.choice(
        "wake-layers",
        "whether layers up to isotropy go on behind trailing edges, along the wakes that the flow finds; needs "
        "use-flow and layers auto; behind blunt bases cell-centred solvers may diverge on it",
        Choices<bool>{{"no", false}, {"yes", true}}, at(&LayerOptions::wake_layers));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<LayerOptions>& option_table();

void validate(const LayerOptions& options) {
    if (!options.enabled) return;
    require_in_range(option_table<LayerOptions>(), options);
    const GrowthLawEntry& law = growth_law_entry(options.growth_law);
    if (law.min_layers > 0 && !options.layers)
        throw OptionError("layers", fmt::format("{} growth needs a number of layers, not auto", law.name));
    if (options.layers && *options.layers < law.min_layers)
        throw OptionError("layers", fmt::format("{} growth needs {} layers or more", law.name, law.min_layers));
    if (law.fills_thickness && !options.thickness)
        throw OptionError("thickness", fmt::format("{} growth needs a thickness", law.name));
}

}  // namespace lamina
