// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace lamina {

/// Throws IoError unless a file can be created in its folder and the name is not that of a folder.
void check_folder_writable(const std::filesystem::path& file);

/// Lets `write` fill a temporary file beside `target`, then renames it to `target`. On any failure the temporary is
/// removed and IoError thrown; an existing target stays as it was. Binary mode, no newline translation.
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path&)>& write);

/// The usual case: `write` sends text or bytes to a stream, whose state is checked at the end.
void write_stream_atomically(const std::filesystem::path& target, const std::function<void(std::ostream&)>& write);

/// The whole file as bytes. Throws IoError.
std::string read_whole_file(const std::filesystem::path& file);

}  // namespace lamina
