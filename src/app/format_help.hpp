// The table of mesh formats, as --help shows it.
#pragma once

#include <string>

namespace lamina::app {

/// "su2|cgns|...".
std::string format_names();

/// One line a format: name, extensions, what it is.
std::string format_help();

}  // namespace lamina::app
