// The options of `lamina mesh`: those of the library's table, and those that say which files to read and write. The
// command line, case files, help, --dump-config and docs/options.md all read this table.
#pragma once

#include <string>
#include <vector>

#include <lamina/option.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// Returns the table, sorted by the headings of the help. Options for the library alone are left out.
const OptionTable<MeshCase>& mesh_options();

/// Returns the option as CLI11 wants it: "--first-height", "-o,--output", "INPUT".
std::string command_line_name(const Option<MeshCase>& option);

/// Sets the option and notes that it was given. Throws UsageError "origin: reason".
void assign(const Option<MeshCase>& option, MeshCase& mesh_case, const OptionValue& value, const std::string& origin);

/// Throws UsageError where options were given that exclude or need each other.
void require_consistent(const MeshCase& mesh_case);

/// Returns the value that arguments from the command line spell. Throws UsageError "origin: reason".
OptionValue value_of_text(OptionKind kind, const std::vector<std::string>& texts, const std::string& origin);

/// Reads a number. Throws UsageError "origin: reason".
double parse_real(const std::string& text, const std::string& origin);

/// Returns what a person reads: "0.1", "fan", "a,b"; an empty list gives an empty text.
std::string to_text(const OptionValue& value);

/// Returns the table of the options in Markdown (docs/options.md).
std::string options_as_markdown();

}  // namespace lamina::app
