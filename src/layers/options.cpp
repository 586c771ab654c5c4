// The table of the layer's options, and what follows from them.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <lamina/layers.hpp>

#include <lamina/option_builders.hpp>
#include "core/reproducible_math.hpp"

namespace lamina::layers {

namespace {

/// A number of YPlus, which the first height becomes when one of them is set.
template <class Member>
Option<LayerOptions>& add_flow_number(OptionTableBuilder<LayerOptions>& table, const char* name, const char* metavar,
                                      const char* help, Member member) {
    const auto of_flow = [member](LayerOptions & options) -> auto& {
        if (!std::holds_alternative<YPlus>(options.first_height)) options.first_height = YPlus{};
        return std::get<YPlus>(options.first_height).*member;
    };
    const auto set = [of_flow, key = option_key(name)](LayerOptions& options, const OptionValue& value) {
        const double number = number_of(value, key);
        require_in(positive_numbers, number, key);
        of_flow(options) = number;
    };
    const auto get = [member](const LayerOptions& options) -> std::optional<OptionValue> {
        const auto* flow = std::get_if<YPlus>(&options.first_height);
        if (!flow) return std::nullopt;
        const std::optional<double> number = flow->*member;
        return number ? std::optional<OptionValue>(*number) : std::nullopt;
    };
    return table.add({name, OptionKind::number, metavar, help, positive_numbers.text(), set, get});
}

OptionTable<LayerOptions> make_table() {
    OptionTableBuilder<LayerOptions> table("Layer");
    const auto at = [](auto LayerOptions::*member) { return member_at(member); };
    const auto set_first_height = [](LayerOptions& options, const OptionValue& value) {
        const double height = number_of(value, "first_height");
        require_in(positive_numbers, height, "first_height");
        options.first_height = height;
    };
    const auto get_first_height = [](const LayerOptions& options) -> std::optional<OptionValue> {
        const auto* height = std::get_if<double>(&options.first_height);
        return height ? std::optional<OptionValue>(*height) : std::nullopt;
    };
    table
        .add({"first-height", OptionKind::number, "H",
              "height of the first layer, measured along the ray, in units of the input", positive_numbers.text(),
              set_first_height, get_first_height})
        .excludes = {"y-plus"};
    add_flow_number(table, "y-plus", "Y", "instead: y+ of the top of the first layer, on a flat plate", &YPlus::y_plus)
        .needs = {"reynolds"};
    add_flow_number(table, "reynolds", "RE", "Reynolds number for y-plus, based on the chord", &YPlus::reynolds)
        .needs = {"y-plus"};
    add_flow_number(table, "chord", "C",
                    "chord for y-plus, in units of the input; else the extent in x of the configuration", &YPlus::chord)
        .needs = {"y-plus"};
    table.number("growth", "R", "ratio of the heights of successive layers, or power of the polynomial law",
                 numbers_above(1), at(&LayerOptions::growth));
    table.choice("growth-law", "how heights grow along a ray",
                 Choices<GrowthLaw>{{"geometric", GrowthLaw::geometric},
                                    {"polynomial", GrowthLaw::polynomial},
                                    {"exponential", GrowthLaw::exponential},
                                    {"adaptive", GrowthLaw::adaptive},
                                    {"aflr", GrowthLaw::aflr}},
                 at(&LayerOptions::growth_law));
    // Layer numbers are kept in 16 bits.
    table.count_or_auto("layers", "N", "number of layers; auto: on each ray up to cells as high as wide",
                        numbers_from_to(1, std::numeric_limits<std::uint16_t>::max()), at(&LayerOptions::layers));
    table.number("thickness", "T", "total height beyond which no layer goes, in units of the input", positive_numbers,
                 at(&LayerOptions::thickness));
    table.flag("no-layers", "isotropic triangles up to the wall", false, at(&LayerOptions::enabled));
    table.number("max-ray-angle", "DEG", "largest angle between neighbouring rays, in degrees",
                 numbers_from_to(0.01, 90), at(&LayerOptions::max_ray_angle_deg));
    table.choice("corners", "at sharp convex corners: a fan of rays, or refining rays beside the vertex",
                 Choices<Corners>{{"fan", Corners::fan}, {"refine", Corners::refine}}, at(&LayerOptions::corners));
    table.choice("layer-topology",
                 "cells of the layer: Delaunay triangles, or the grid of rays and layers, cut or left whole",
                 Choices<LayerTopology>{{"delaunay", LayerTopology::delaunay},
                                        {"layered", LayerTopology::layered},
                                        {"quads", LayerTopology::quads}},
                 at(&LayerOptions::topology));
    return table.take();
}

}  // namespace

}  // namespace lamina::layers

namespace lamina {

const OptionTable<LayerOptions>& layer_option_table() {
    static const OptionTable<LayerOptions> table = layers::make_table();
    return table;
}

void validate(const LayerOptions& options) {
    if (!options.enabled) return;
    require_in_range(layer_option_table(), options);
    if (options.growth_law == GrowthLaw::adaptive && !options.layers)
        throw OptionError("layers", "adaptive growth needs a number of layers, not auto");
    if (options.growth_law == GrowthLaw::exponential && (!options.layers || *options.layers < 2 || !options.thickness))
        throw OptionError("thickness", "exponential growth needs a thickness and 2 layers or more");
}

void validate(const BorderOptions& options) {
    require_in(numbers_above(1), options.max_ratio, "max_ratio");
    require_in(positive_numbers, options.gradation, "gradation");
    if (!(options.max_edge > 0)) throw OptionError("max_edge", "must be greater than 0");
    if (options.ray_gradation) require_in(positive_numbers, *options.ray_gradation, "ray_gradation");
}

LayerGrowth layer_growth(const LayerOptions& options, double chord) {
    if (!options.enabled) return {};
    LayerGrowth growth{options.growth_law, 0, options.growth, options.layers, options.thickness};
    if (const auto* height = std::get_if<double>(&options.first_height)) {
        growth.first_height = *height;
    } else {
        const YPlus& flow = std::get<YPlus>(options.first_height);
        growth.first_height = first_height_for(flow.y_plus, flow.reynolds, flow.chord.value_or(chord));
    }
    if (growth.thickness && !(*growth.thickness >= growth.first_height))
        throw OptionError("thickness",
                          fmt::format("{} is less than the first height {}", *growth.thickness, growth.first_height));
    if (growth.law == GrowthLaw::exponential && !(*growth.thickness > *growth.layers * growth.first_height))
        throw OptionError("thickness",
                          fmt::format("{} is no more than {} layers of {}: exponential growth has nothing to grow",
                                      *growth.thickness, *growth.layers, growth.first_height));
    return growth;
}

double first_height_for(double y_plus, double reynolds, double chord) {
    require_in(positive_numbers, y_plus, "y_plus");
    require_in(positive_numbers, reynolds, "reynolds");
    require_in(positive_numbers, chord, "chord");
    const double friction = 0.026 / core::pow_reproducible(reynolds, 1.0 / 7);
    return y_plus * chord / (reynolds * std::sqrt(0.5 * friction));
}

}  // namespace lamina
