// Options of commands that take single rows of an option table.
#pragma once

#include <string>
#include <vector>

#include <lamina/option.hpp>

#include "app/command_line.hpp"
#include "app/options.hpp"

namespace lamina::app {

/// Adds an option of a table to a command. `text` receives the value that the user gives.
template <class Options>
AddedOption add_table_option(CLI::App& command, const OptionTable<Options>& table, const std::string& name,
                             std::string& text) {
    const Option<Options>& option = find_row(table, name);
    return add_option(command, "--" + name, text, help_with_range(option)).type_name(option.metavar);
}

/// Adds a flag of a table to a command.
template <class Options>
AddedOption add_table_flag(CLI::App& command, const OptionTable<Options>& table, const std::string& name, bool& flag) {
    return add_flag(command, "--" + name, flag, help_with_range(find_row(table, name)));
}

/// Does so; the text is "true" where it is given.
template <class Options>
AddedOption add_table_flag(CLI::App& command, const OptionTable<Options>& table, const std::string& name,
                           std::string& text) {
    return add_text_flag(command, "--" + name, text, find_row(table, name).help);
}

/// Adds an option of a table that may be given several times; `texts` receives the values.
template <class Options>
AddedOption add_repeated_table_option(CLI::App& command, const OptionTable<Options>& table, const std::string& name,
                                      std::vector<std::string>& texts) {
    const Option<Options>& option = find_row(table, name);
    return add_option(command, "--" + name, texts, help_with_range(option)).type_name(option.metavar).repeated();
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
