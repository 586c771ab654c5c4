// lamina yplus: first heights by hand, without a section.
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <lamina/conditions.hpp>
#include <lamina/error.hpp>
#include <lamina/layers.hpp>
#include <lamina/plate.hpp>

#include "app/commands.hpp"
#include "app/standard_output.hpp"
#include "app/summary.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct YPlusArguments {
    std::map<std::string, std::string> conditions;  ///< values by the names of option_table<FlowConditions>()
    std::map<std::string, std::string> layer;       ///< likewise, of option_table<LayerOptions>()
};

void print_layer(const YPlusArguments& arguments) {
    FlowConditions conditions{.chord = 1};
    for (const auto& [name, value] : arguments.conditions)
        set_by_name(option_table<FlowConditions>(), name, value, conditions);
    LayerOptions options{.first_height = YPlus{1}};
    for (const auto& [name, value] : arguments.layer) set_by_name(option_table<LayerOptions>(), name, value, options);
    if (!arguments.layer.at("y-plus").empty() && !arguments.layer.at("first-height").empty())
        throw UsageError("y-plus and first-height exclude each other: give one of them");
    const ReferenceConditions reference = reference_conditions(conditions, Box{});
    if (!reference.reynolds) throw OptionError("reynolds", "is needed, or velocity and viscosity");
    const double chord = reference.chord, reynolds = *reference.reynolds;
    const auto* height = std::get_if<Length>(&options.first_height);
    const PlateLayer layer = height
                                 ? plate_layer_of_height(in_units(*height, chord), reynolds, chord, options.growth)
                                 : plate_layer(std::get<YPlus>(options.first_height), reynolds, chord, options.growth);
    const auto length = [&](double value) {
        return fmt::format("{:.4g} chords, {:.4g} units of the input", value / chord, value);
    };
    print_result(fmt::format("flat plate at Reynolds number {:.6g}, of chord {:.6g}\n", reynolds, chord) +
                 summary_line("y+", fmt::format("{:.4g}", layer.y_plus)) +
                 summary_line("first layer", length(layer.first_height)) +
                 summary_line("friction", fmt::format("coefficient {:.4g}", layer.skin_friction)) +
                 summary_line("thickness", length(layer.thickness) + " of the boundary layer at the trailing edge") +
                 summary_line("layers", fmt::format("{} of growth {:g} are as high", layer.layers, options.growth)));
}

}  // namespace

void add_yplus_command(CLI::App& app) {
    CLI::App* command = add_command(app, "yplus", "compute first heights from y+ on a flat plate, without a section");
    auto arguments = std::make_shared<YPlusArguments>();
    for (const char* name : {"reynolds", "velocity", "viscosity", "chord"})
        add_table_option(*command, option_table<FlowConditions>(), name, arguments->conditions[name]);
    for (const char* name : {"y-plus", "first-height", "growth"})
        add_table_option(*command, option_table<LayerOptions>(), name, arguments->layer[name]);
    set_footer(*command, "Without --y-plus and --first-height, y+ is 1. A first height gives its y+ instead.");
    run_with(*command, [arguments] { print_layer(*arguments); });
}

}  // namespace lamina::app
