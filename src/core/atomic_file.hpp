// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <string>

#include <lamina/export.hpp>

namespace lamina::core {

/// Lets `write` fill a temporary file beside `target`, then renames it to `target`. On any failure the temporary is
/// removed and IoError thrown; an existing target stays as it was. Binary mode, no newline translation.
LAMINA_EXPORT void write_atomically(const std::filesystem::path& target,
                                    const std::function<void(const std::filesystem::path&)>& write);

/// Several files that belong together: `write` fills the temporary of each target, and none is renamed before all are
/// complete.
LAMINA_EXPORT void write_files_atomically(std::span<const std::filesystem::path> targets,
                                          const std::function<void(std::span<const std::filesystem::path>)>& write);

/// A folder of files: `write` fills a temporary folder beside `target`, which then takes its place. A folder that was
/// there goes with everything in it. Folders above it that are missing are made, and go again on failure.
LAMINA_EXPORT void write_folder_atomically(const std::filesystem::path& target,
                                           const std::function<void(const std::filesystem::path&)>& write);

/// Throws IoError where the disk has no room for a file of this many bytes beside `target`, as far as it can be asked.
/// For writers that do not survive a full disk.
LAMINA_EXPORT void require_room(const std::filesystem::path& target, std::size_t bytes);

/// Fills one file through a stream, whose state is checked at the end; errors name `target`.
LAMINA_EXPORT void write_stream(const std::filesystem::path& file, const std::filesystem::path& target,
                                const std::function<void(std::ostream&)>& write);

/// The usual case: one file, through a stream. A device or a pipe is written to as it stands.
LAMINA_EXPORT void write_stream_atomically(const std::filesystem::path& target,
                                           const std::function<void(std::ostream&)>& write);

}  // namespace lamina::core
