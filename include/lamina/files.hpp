// Reading and writing of whole files.
//
// Guarantees:
//  1. A file that is written gets a temporary name beside the target and is renamed, so that a failure leaves nothing
//     half-written. Devices, pipes and standard output are written to directly.
//  2. Functions throw IoError, which names the file, and no other error.
//  3. "-" stands for standard input where a file is read, and for standard output where one is written.
// Example:
//     write_file("note.txt", "six words\n");
//     assert(read_file("note.txt") == "six words\n");
//     assert(missing_folders("a/b/note.txt").size() == 2);
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>

namespace lamina {

LAMINA_EXPORT bool is_standard_stream(const std::filesystem::path& file);  ///< whether the name is "-"

/// Returns the name of a file that is read as messages show it: "standard input" for "-".
LAMINA_EXPORT std::string input_name(const std::filesystem::path& file);
/// Texts of airfoils and of options are refused beyond this size, which some ten million points do not reach.
inline constexpr std::size_t max_text_bytes = std::size_t{1} << 30;
/// Returns the whole file. Throws, too, where it exceeds `max_bytes` (but for a mebibyte) or, without end, free memory.
LAMINA_EXPORT std::string read_file(const std::filesystem::path& file,
                                    std::size_t max_bytes = std::numeric_limits<std::size_t>::max());
/// Writes the text as the whole file.
LAMINA_EXPORT void write_file(const std::filesystem::path& file, const std::string& text);
/// Throws unless a file can be created in the folder of this file, and where that is a folder or a read-only file.
LAMINA_EXPORT void check_folder_writable(const std::filesystem::path& file);
/// Returns the folders above this file that do not exist, the outermost one first.
LAMINA_EXPORT std::vector<std::filesystem::path> missing_folders(const std::filesystem::path& file);
/// Creates the folders above this file that do not exist.
LAMINA_EXPORT void create_folders_above(const std::filesystem::path& file);
/// Returns the folders that hold temporary files while this process writes these files or folders.
LAMINA_EXPORT std::vector<std::filesystem::path> folders_of_temporaries(std::span<const std::filesystem::path> targets);
/// Removes the temporary files that this process would leave in a folder if it ended while it writes, and gives an old
/// folder its name back. Returns whether there were any. On Linux its second call needs neither memory nor locks.
LAMINA_EXPORT bool remove_temporaries_in(const char* folder) noexcept;

}  // namespace lamina
