// Files that appear as a whole or not at all: they are written under a temporary name and then renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <vector>

#include <lamina/export.hpp>

namespace lamina::core {

/// Returns whether the name is that of a device or a pipe, which cannot be replaced by a file.
bool is_device(const std::filesystem::path& file);

/// Returns the folder of a file, "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Creates folders, and removes those of them that are empty at its end, the last one first, unless they are kept.
class LAMINA_EXPORT NewFolders {
public:
    NewFolders() = default;
    ~NewFolders();
    NewFolders(const NewFolders&) = delete;
    NewFolders& operator=(const NewFolders&) = delete;

    /// Creates the folders above this file that do not exist. Throws IoError about the folder.
    void create_above(const std::filesystem::path& file);
    /// Keeps all that were created.
    void keep() { created_.clear(); }

private:
    std::vector<std::filesystem::path> created_;
};

/// Calls write(temporary) with the name of a file in a temporary folder beside `target` (temporary_folder.hpp) and
/// renames that file to `target`, with the owner and the permissions of the file that it replaces. Where `target` is a
/// symbolic link, the file behind it is replaced. On any failure the temporary file is removed, an existing target
/// stays as it was, and IoError is thrown where the file system failed; other exceptions of `write` pass through. What
/// killed processes have left beside the target is removed.
LAMINA_EXPORT void write_atomically(const std::filesystem::path& target,
                                    const std::function<void(const std::filesystem::path&)>& write);

/// Does the same for several files that belong together: `write` gets one temporary name per target, and no file is
/// renamed before all are complete. Of two processes that write the same files, one after the other renames its own, as
/// far as the file system has locks.
LAMINA_EXPORT void write_files_atomically(std::span<const std::filesystem::path> targets,
                                          const std::function<void(std::span<const std::filesystem::path>)>& write);

/// Does the same for a folder: `write` fills a temporary folder, which then takes the place of `target`. An old folder
/// of that name, or a symbolic link, is removed with all its files; both are exchanged at once where the file system
/// can. Missing folders above it are created, and removed again on failure.
LAMINA_EXPORT void write_folder_atomically(const std::filesystem::path& target,
                                           const std::function<void(const std::filesystem::path&)>& write);

/// Creates or empties a file of this many bytes, and has the disk keep room for them, as far as the file system can.
/// Throws IoError about the target where there is none. Writers that do not survive a full disk need this.
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
