// The arguments of the program: reads them, and says what was probably meant where they are wrong.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.hpp"

namespace lamina::app {

/// The end of the names of groups of options that --help leaves to --help-all.
inline constexpr std::string_view further_options = ", further";

/// Runs the command that the arguments name. `lamina help COMMAND` and `lamina version` do the same as the options.
/// Throws UsageError with a hint for unknown commands and options, and the errors of the command.
void run_arguments(CLI::App& app, std::vector<std::string> arguments);

}  // namespace lamina::app
