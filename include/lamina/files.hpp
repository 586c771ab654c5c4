// Reading and writing of whole files. The name "-" stands for standard input where a file is read, and for standard
// output where one is written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>

namespace lamina {

/// Returns whether the name is "-", which stands for standard input or standard output.
LAMINA_EXPORT bool is_standard_stream(const std::filesystem::path& file);

/// Returns the name of a file that is read as messages show it: "standard input" for "-".
LAMINA_EXPORT std::string input_name(const std::filesystem::path& file);

/// Texts of airfoils and of options are refused beyond this size, which some ten million points do not reach.
inline constexpr std::size_t max_text_bytes = std::size_t{1} << 30;

/// Returns the whole file as bytes. Throws IoError; so it does where the file is larger than `max_bytes` (but for a
/// mebibyte) or, as a device without an end, than the memory that is free.
LAMINA_EXPORT std::string read_file(const std::filesystem::path& file,
                                    std::size_t max_bytes = std::numeric_limits<std::size_t>::max());

/// Writes the text to a temporary file beside `file` and renames it, so that a failure leaves no half-written file. A
/// device, a pipe or standard output is written to directly. Throws IoError.
LAMINA_EXPORT void write_file(const std::filesystem::path& file, const std::string& text);

/// Throws IoError unless a file can be created in the folder of this file. Throws it, too, where the name is that of a
/// folder or of a read-only file, which renaming would replace.
LAMINA_EXPORT void check_folder_writable(const std::filesystem::path& file);

/// Returns the folders above this file that do not exist, the outermost one first.
LAMINA_EXPORT std::vector<std::filesystem::path> missing_folders(const std::filesystem::path& file);

/// Creates the folders above this file that do not exist. Throws IoError.
LAMINA_EXPORT void create_folders_above(const std::filesystem::path& file);

/// Returns the folders that hold temporary files while this process writes these files or folders.
LAMINA_EXPORT std::vector<std::filesystem::path> folders_of_temporaries(std::span<const std::filesystem::path> targets);

/// Removes what this process would leave in a folder if it ended while it writes: temporary files. An old folder that was
/// to be replaced gets its name back. Returns whether there was anything to remove. On Linux it needs neither memory nor
/// locks from the second call on. Never throws.
LAMINA_EXPORT bool remove_temporaries_in(const char* folder) noexcept;

}  // namespace lamina
