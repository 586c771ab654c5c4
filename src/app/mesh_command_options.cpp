#include "app/mesh_command_options.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include <lamina/error.hpp>

#include "app/arguments.hpp"
#include "app/options.hpp"
#include "app/presets.hpp"
#include "app/progress.hpp"

namespace lamina::app {

namespace {

/// The options that most meshes need, in tasks: those that the short help shows.
constexpr std::string_view short_help[] = {"input",     "output",       "preset",         "format",         "report",
                                           "html",      "surface",      "surface-points", "names",          "transform",
                                           "alpha",     "chord",        "mach",           "reynolds",       "y-plus",
                                           "growth",    "first-height", "layers",         "layer-topology", "no-layers",
                                           "far-field", "gradation",    "wake",           "refine",         "threads"};

CLI::Option* add_option(CLI::App& command, const Option<MeshCase>& option) {
    const std::string help = help_text(option);
    const bool is_short = std::find(std::begin(short_help), std::end(short_help), option.name) != std::end(short_help);
    const std::string group = option.group + (is_short ? "" : std::string(further_options));
    if (option.kind == OptionKind::flag) return command.add_flag(command_line_name(option), help)->group(group);

    // The option is set only once the case file is read, so nothing is done with its value here.
    CLI::Option* given = command.add_option(
        command_line_name(option), [](const CLI::results_t&) { return true; }, help);
    given->group(group)->type_name(option.metavar);
    if (option.kind == OptionKind::words) return given->delimiter(',')->expected(1, -1)->allow_extra_args(false);
    if (option.kind == OptionKind::repeated)
        return given->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (option.kind != OptionKind::paths) return given->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    return given->expected(1, -1)->allow_extra_args(given->get_positional());
}

/// Returns the preset that the further options or the command line name.
std::optional<std::string> preset_of_command_line(const GivenOptions& options, const std::vector<OptionText>& further) {
    for (const auto& [option, text] : further)
        if (option->name == preset_option) return text;
    for (const auto& [option, given] : options)
        if (option->name == preset_option && given->count() > 0) return given->results().back();
    return {};
}

/// Returns whether the command line or the further options say the Reynolds number.
bool has_reynolds(const GivenOptions& options, const std::vector<OptionText>& further) {
    const auto says_it = [](const Option<MeshCase>* option) {
        return std::find(std::begin(reynolds_options), std::end(reynolds_options), option->name) !=
               std::end(reynolds_options);
    };
    return std::any_of(options.begin(), options.end(),
                       [&](const auto& entry) { return entry.second->count() > 0 && says_it(entry.first); }) ||
           std::any_of(further.begin(), further.end(), [&](const auto& entry) { return says_it(entry.first); });
}

}  // namespace

GivenOptions add_mesh_options(CLI::App& command, const std::vector<std::string_view>& left_out) {
    GivenOptions options;
    for (const Option<MeshCase>& option : mesh_options())
        if (std::find(left_out.begin(), left_out.end(), option.name) == left_out.end())
            options.emplace_back(&option, add_option(command, option));
    return options;
}

std::vector<std::string> given_texts(const GivenOptions& options, const std::string& name) {
    for (const auto& [option, given] : options)
        if (option->name == name && given->count() > 0) return given->results();
    return {};
}

MeshCase case_of_command_line(const GivenOptions& options) {
    for (const auto& [option, given] : options)
        if (given->get_positional()) return case_of_command_line(options, given->results(), {});
    return {};
}

MeshCase case_of_command_line(const GivenOptions& options, const std::vector<std::string>& inputs,
                              const std::vector<OptionText>& further) {
    MeshCase mesh_case =
        case_of_inputs(inputs, preset_of_command_line(options, further), has_reynolds(options, further));
    const auto set = [&](const Option<MeshCase>& option, const std::vector<std::string>& texts) {
        const std::string origin = "option --" + option.name;
        assign(option, mesh_case, value_of_text(option.kind, texts, origin), origin);
    };
    for (const auto& [option, given] : options)
        if (!given->get_positional() && given->count() > 0) set(*option, given->results());
    for (const auto& [option, text] : further) set(*option, {text});
    require_any_body(mesh_case);
    return mesh_case;
}

}  // namespace lamina::app
