// The table of mesh formats in help texts.
#pragma once

#include <string>

#include "app/command_line.hpp"

namespace lamina::app {

/// Adds the option --input-format, which receives the format of a mesh that is read.
void add_input_format(CLI::App& command, std::string& format);

/// Returns the names of all formats: "su2|cgns|...".
std::string format_names();

/// Returns one line per format: its name, its extensions and its description.
std::string format_help();

}  // namespace lamina::app
