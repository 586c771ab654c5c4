#include "app/command_facts.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <CLI/CLI.hpp>

namespace lamina::app {

namespace {

/// Returns the words between the bars of "auto|keep|resample". Words in capital letters stand for other values.
std::vector<std::string> choices_in(const std::string& value) {
    std::vector<std::string> choices;
    if (value.find('|') == std::string::npos) return choices;
    for (std::size_t at = 0; at <= value.size();) {
        const std::size_t end = std::min(value.find('|', at), value.size());
        const std::string word = value.substr(at, end - at);
        if (std::none_of(word.begin(), word.end(), [](char c) { return c >= 'A' && c <= 'Z'; }))
            choices.push_back(word);
        at = end + 1;
    }
    return choices;
}

bool names_file(const std::string& value) {
    constexpr std::array<std::string_view, 7> files{"FILE", "DIR", "STEM", "INPUT", "MESH", "IN", "OUT"};
    return std::find(files.begin(), files.end(), value) != files.end();
}

OptionFacts facts_of(const CLI::Option& option) {
    OptionFacts facts;
    for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
    if (facts.names.empty()) facts.names.push_back(option.get_name());
    if (option.get_items_expected_max() > 0)
        facts.value = option.get_positional() ? facts.names.front() : option.get_type_name();
    facts.help = option.get_description();
    facts.group = option.get_group();
    facts.choices = choices_in(option.get_positional() ? option.get_type_name() : facts.value);
    facts.takes_file = names_file(facts.value);
    facts.repeats =
        option.get_items_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    return facts;
}

}  // namespace

std::vector<CommandFacts> facts_of_commands(const CLI::App& app) {
    std::vector<CommandFacts> commands;
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_group().empty()) continue;
        CommandFacts facts{command->get_name(), command->get_description(), command->get_footer(), {}, {}};
        for (const CLI::Option* option : command->get_options()) {
            if (option->get_group().empty()) continue;
            (option->get_positional() ? facts.arguments : facts.options).push_back(facts_of(*option));
        }
        commands.push_back(std::move(facts));
    }
    return commands;
}

std::vector<std::string> option_names(const CommandFacts& command) {
    std::vector<std::string> names;
    for (const OptionFacts& option : command.options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

}  // namespace lamina::app
