// Parts of the names of files. They stand here because <filesystem> takes long to compile.
#pragma once

#include <filesystem>
#include <string>

#include "core/text.hpp"

namespace lamina::core {

/// Returns the extension of a file's name, in lower case and with the dot.
inline std::string extension_of(const std::filesystem::path& file) { return lower_case(file.extension().string()); }

}  // namespace lamina::core
