// The options of `lamina mesh`: those of the library's table, and those that name the files to read and write. The
// command line, case files, help, --dump-config and docs/options.md all read this table.
#pragma once

#include <string>
#include <vector>

#include <lamina/option.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// Returns the table, sorted by the headings of the help. Options for the library alone are left out.
const OptionTable<MeshCase>& mesh_options();

/// Returns the name of the option in the form that CLI11 takes: "--first-height", "-o,--output", "INPUT".
std::string command_line_name(const Option<MeshCase>& option);

/// Returns the description of an option with the range of its values.
template <class Options>
std::string help_with_range(const Option<Options>& option) {
    return option.help + (option.range.empty() ? "" : "; " + option.range);
}

/// Returns the default of an option as a person reads it; empty for flags and options without a default.
std::string default_text(const Option<MeshCase>& option);

/// Returns the description of an option with the range of its values and its default in brackets.
std::string help_text(const Option<MeshCase>& option);

/// Sets the option and notes that it was given. `origin` says where, for errors. Throws UsageError "origin: reason".
void assign(const Option<MeshCase>& option, MeshCase& mesh_case, const OptionValue& value, const std::string& origin);

/// Returns whether a case file or the command line gave the option of this name.
bool is_given(const MeshCase& mesh_case, const std::string& name);

/// Throws UsageError where options were given that exclude or need each other, or whose values do not go together.
void require_consistent(const MeshCase& mesh_case);

/// Returns the value of an option of this kind that arguments of the command line stand for. Throws UsageError "origin:
/// reason".
OptionValue value_of_text(OptionKind kind, const std::vector<std::string>& texts, const std::string& origin);

/// Reads a number that fills the whole text. Throws UsageError "origin: reason".
double parse_real(const std::string& text, const std::string& origin);

/// Returns the value as a person reads it: "0.1", "fan", "a,b". An empty list gives an empty text.
std::string to_text(const OptionValue& value);

}  // namespace lamina::app
