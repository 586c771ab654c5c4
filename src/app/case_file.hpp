// case.toml: the options of `lamina mesh` under their own names, with underscores (docs/guide.md, "Case files").
#pragma once

#include <filesystem>
#include <string>

#include "app/case.hpp"

namespace lamina::app {

/// Paths in the file are relative to its folder. Throws IoError where it cannot be read, InputError where it is no
/// TOML, UsageError (file, line, key) for unknown keys and values out of range.
MeshCase read_case_file(const std::filesystem::path& file);

/// The complete case as TOML; reading it back gives an equal case from any folder, since paths are made absolute.
std::string dump_case(const MeshCase& mesh_case);

}  // namespace lamina::app
