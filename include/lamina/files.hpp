// Files as texts that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>

#include <lamina/export.hpp>

namespace lamina {

/// Returns the whole file as bytes. Throws IoError.
LAMINA_EXPORT std::string read_file(const std::filesystem::path& file);

/// Writes the text under a temporary name beside the file and renames it, so that a failure leaves nothing
/// half-written. A device or a pipe is written to as it stands. Throws IoError.
LAMINA_EXPORT void write_file(const std::filesystem::path& file, const std::string& text);

/// Throws IoError unless a file can be created in the folder of this file and the name is not that of a folder.
LAMINA_EXPORT void check_folder_writable(const std::filesystem::path& file);

}  // namespace lamina
