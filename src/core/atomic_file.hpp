// Files that appear as a whole or not at all: they are written under a temporary name and then renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>

#include <lamina/export.hpp>

namespace lamina::core {

/// Returns whether the name is that of a device or a pipe, which cannot be replaced by a file.
bool is_device(const std::filesystem::path& file);

/// Returns the folder of a file, "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Calls write(temporary) with the name of a temporary file beside `target` and renames that file to `target`. On any
/// failure the temporary file is removed, an existing target stays as it was, and IoError is thrown where the file
/// system failed; other exceptions of `write` pass through.
LAMINA_EXPORT void write_atomically(const std::filesystem::path& target,
                                    const std::function<void(const std::filesystem::path&)>& write);

/// Does the same for several files that belong together: `write` gets one temporary name per target, and no file is
/// renamed before all are complete.
LAMINA_EXPORT void write_files_atomically(std::span<const std::filesystem::path> targets,
                                          const std::function<void(std::span<const std::filesystem::path>)>& write);

/// Does the same for a folder: `write` fills a temporary folder, which then takes the place of `target`. An old folder
/// of that name is removed with all its files. Missing folders above it are created, and removed again on failure.
LAMINA_EXPORT void write_folder_atomically(const std::filesystem::path& target,
                                           const std::function<void(const std::filesystem::path&)>& write);

/// Throws IoError where the disk has no room for a file of this many bytes beside `target`, as far as the file system
/// can tell. Writers that do not survive a full disk need this.
LAMINA_EXPORT void require_room(const std::filesystem::path& target, std::size_t bytes);

/// Creates or empties a file of this many bytes, and has the disk keep room for them, as far as the file system can. Throws
/// IoError about the target where there is none.
LAMINA_EXPORT void reserve_room(const std::filesystem::path& file, const std::filesystem::path& target,
                                std::size_t bytes);

/// Calls write(stream) with a binary stream to `file`, and throws IoError, which names `target`, where the stream has
/// failed in the end.
LAMINA_EXPORT void write_stream(const std::filesystem::path& file, const std::filesystem::path& target,
                                const std::function<void(std::ostream&)>& write);

/// Calls write(stream) with a binary stream to a temporary file, which then becomes `target`, as in write_atomically().
/// A device, a pipe or standard output ("-") is written to directly.
LAMINA_EXPORT void write_stream_atomically(const std::filesystem::path& target,
                                           const std::function<void(std::ostream&)>& write);

}  // namespace lamina::core
