// Names of files made from other names.
#pragma once

#include <filesystem>

namespace lamina::io {

/// Returns the stem with a suffix: "wing.1.node" for "wing.1" and ".node".
inline std::filesystem::path with_suffix(std::filesystem::path stem, const char* suffix) { return stem += suffix; }

}  // namespace lamina::io
