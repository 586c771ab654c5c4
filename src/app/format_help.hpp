// The table of mesh formats in help texts.
#pragma once

#include <string>

namespace lamina::app {

/// Returns the names of all formats: "su2|cgns|...".
std::string format_names();

/// Returns one line per format: its name, its extensions and its description.
std::string format_help();

}  // namespace lamina::app
