// Case files: the options of `lamina mesh` in TOML, under their own names with underscores for hyphens
// (docs/reference/command-line.md, "Case files").
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/case.hpp"

namespace lamina::app {

/// Reads a case file. Paths in it are relative to its folder. The preset, if one is given, replaces that of the file;
/// the file's other options go over it. Throws IoError where it cannot be read, InputError where it is no TOML,
/// UsageError (with file, line and key) for unknown keys and values out of range.
MeshCase read_case_file(const std::filesystem::path& file, const std::optional<std::string>& preset = {},
                        bool has_reynolds = false);

/// Returns the complete case as TOML. Paths are made absolute, so read_case_file() returns an equal case from any
/// folder.
std::string dump_case(const MeshCase& mesh_case);

}  // namespace lamina::app
