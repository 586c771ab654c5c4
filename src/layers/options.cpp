// The table of the layer's options, and the checks of them.
#include <limits>

#include <fmt/format.h>

#include <lamina/layers.hpp>
#include <lamina/option_builders.hpp>

#include "layers/growth_laws.hpp"

namespace lamina::layers {

namespace {

/// Adds an option that sets a number of YPlus. Setting one of them replaces a first height given as a length.
template <class Member>
Option<LayerOptions>& add_flow_number(OptionTableBuilder<LayerOptions>& table, const char* name, const char* metavar,
                                      const char* help, Member member) {
    const auto flow_member = [member](LayerOptions & options) -> auto& {
        if (!std::holds_alternative<YPlus>(options.first_height)) options.first_height = YPlus{};
        return std::get<YPlus>(options.first_height).*member;
    };
    const auto set = [flow_member, key = option_key(name)](LayerOptions& options, const OptionValue& value) {
        const double number = as_number(value, key);
        require_in_range(positive_numbers, number, key);
        flow_member(options) = number;
    };
    const auto get = [member](const LayerOptions& options) -> std::optional<OptionValue> {
        const auto* flow = std::get_if<YPlus>(&options.first_height);
        if (!flow) return std::nullopt;
        const std::optional<double> number = flow->*member;
        return number ? std::optional<OptionValue>(*number) : std::nullopt;
    };
    return table.add({name, OptionKind::number, metavar, help, positive_numbers.text(), set, get});
}

/// Adds the options of the first height: a length, or the flow that it follows from.
void add_first_height(OptionTableBuilder<LayerOptions>& table) {
    const auto set_first_height = [](LayerOptions& options, const OptionValue& value) {
        const double height = as_number(value, "first_height");
        require_in_range(positive_numbers, height, "first_height");
        options.first_height = height;
    };
    const auto get_first_height = [](const LayerOptions& options) -> std::optional<OptionValue> {
        const auto* height = std::get_if<double>(&options.first_height);
        return height ? std::optional<OptionValue>(*height) : std::nullopt;
    };
    table
        .add({"first-height", OptionKind::number, "H",
              "height of the first layer above the wall, in units of the input", positive_numbers.text(),
              set_first_height, get_first_height})
        .excludes = {"y-plus"};
    add_flow_number(table, "y-plus", "Y", "instead: y+ of the top of the first layer, on a flat plate", &YPlus::y_plus)
        .needs = {"reynolds"};
    add_flow_number(table, "reynolds", "RE", "Reynolds number for y-plus, based on the chord", &YPlus::reynolds)
        .needs = {"y-plus"};
    add_flow_number(table, "chord", "C",
                    "chord for y-plus, in units of the input; else the extent in x of the configuration", &YPlus::chord)
        .needs = {"y-plus"};
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

OptionTable<LayerOptions> make_table() {
    OptionTableBuilder<LayerOptions> table("Layer");
    const auto at = [](auto LayerOptions::*member) { return member_at(member); };
    add_first_height(table);
    table.number("growth", "R", "ratio of the heights of successive layers, or power of the polynomial law",
                 numbers_above(1), at(&LayerOptions::growth));
    add_growth_law(table);
    // Layer::layer_of_point has 16 bits.
    table.count_or_auto("layers", "N", "number of layers; auto: on each ray up to cells as high as wide",
                        numbers_from_to(1, std::numeric_limits<std::uint16_t>::max()), at(&LayerOptions::layers));
    table.number("thickness", "T", "total height beyond which no layer goes, in units of the input", positive_numbers,
                 at(&LayerOptions::thickness));
    table.flag("no-layers", "isotropic triangles up to the wall", false, at(&LayerOptions::enabled));
    table.number("max-ray-angle", "DEG", "largest angle between neighbouring rays, in degrees",
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
    return table.take();
}

}  // namespace

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

const OptionTable<LayerOptions>& layer_option_table() {
    static const OptionTable<LayerOptions> table = make_table();
    return table;
}

void validate(const LayerOptions& options) {
    if (!options.enabled) return;
    require_in_range(layer_option_table(), options);
    const GrowthLawEntry& law = growth_law_entry(options.growth_law);
    if (law.min_layers > 0 && !options.layers)
        throw OptionError("layers", fmt::format("{} growth needs a number of layers, not auto", law.name));
    if (options.layers && *options.layers < law.min_layers)
        throw OptionError("layers", fmt::format("{} growth needs {} layers or more", law.name, law.min_layers));
    if (law.fills_thickness && !options.thickness)
        throw OptionError("thickness", fmt::format("{} growth needs a thickness", law.name));
}

void validate(const BorderOptions& options) {
    require_in_range(numbers_above(1), options.max_ratio, "max_ratio");
    require_in_range(positive_numbers, options.gradation, "gradation");
    if (!(options.max_edge > 0)) throw OptionError("max_edge", "must be greater than 0");
}

}  // namespace lamina
