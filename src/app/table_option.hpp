// Options of commands that take single rows of an option table.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <lamina/option.hpp>

#include "app/options.hpp"

namespace lamina::app {

/// Adds an option of a table to a command. `text` receives the value that the user gives.
template <class Options>
CLI::Option* add_table_option(CLI::App& command, const OptionTable<Options>& table, const std::string& name,
                              std::string& text) {
    const Option<Options>& option = find_row(table, name);
    return command.add_option("--" + name, text, help_with_range(option))->type_name(option.metavar);
}

/// Adds a flag of a table to a command; the text is "true" where it is given.
template <class Options>
CLI::Option* add_table_flag(CLI::App& command, const OptionTable<Options>& table, const std::string& name,
                            std::string& text) {
    return command.add_flag_callback(
        "--" + name, [&text] { text = "true"; }, find_row(table, name).help);
}

/// Adds an option of a table that may be given several times; `texts` receives the values.
template <class Options>
CLI::Option* add_repeated_table_option(CLI::App& command, const OptionTable<Options>& table, const std::string& name,
                                       std::vector<std::string>& texts) {
    const Option<Options>& option = find_row(table, name);
    return command.add_option("--" + name, texts, help_with_range(option))
        ->type_name(option.metavar)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

/// Sets an option of a table to values from the command line; none leave the default. Throws UsageError "option --name:
/// reason".
template <class Options>
void set_by_name(const OptionTable<Options>& table, const std::string& name, const std::vector<std::string>& texts,
                 Options& options) {
    if (texts.empty()) return;
    const Option<Options>& option = find_row(table, name);
    const std::string origin = "option --" + name;
    try {
        option.set(options, value_of_text(option.kind, texts, origin));
    } catch (const OptionError& error) {
        throw UsageError(origin + ": " + error.reason());
    }
}

/// Does so with one value; an empty text leaves the default.
template <class Options>
void set_by_name(const OptionTable<Options>& table, const std::string& name, const std::string& text,
                 Options& options) {
    if (!text.empty()) set_by_name(table, name, std::vector{text}, options);
}

}  // namespace lamina::app
