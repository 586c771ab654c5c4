// Reading and writing of whole files.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <lamina/export.hpp>

namespace lamina {

/// Returns the whole file as bytes. Throws IoError.
LAMINA_EXPORT std::string read_file(const std::filesystem::path& file);

/// Writes the text to a temporary file beside `file` and renames it, so that a failure leaves no half-written file. A
/// device or a pipe is written to directly. Throws IoError.
LAMINA_EXPORT void write_file(const std::filesystem::path& file, const std::string& text);

/// Throws IoError unless a file can be created in the folder of this file. Throws it, too, where the name is that of a
/// folder.
LAMINA_EXPORT void check_folder_writable(const std::filesystem::path& file);

/// Removes what this process leaves behind if it is ended while it writes these files or folders: temporary files. An
/// old folder that was to be replaced gets its name back. Never throws.
LAMINA_EXPORT void remove_temporaries(std::span<const std::filesystem::path> targets) noexcept;

}  // namespace lamina
