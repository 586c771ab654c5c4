// Folders that hold files until these are complete and get their names: nobody else can lay anything into them, and
// what a process that was killed leaves of them is found and cleared.
//
// A folder is called .lamina-PROCESS-BOOT-RANDOM, of hexadecimal digits. PROCESS is a random number of the process that
// makes it, so that a signal can clear all that this process leaves. BOOT is of the identity that Linux gives to itself
// when it starts, so that no other machine on a network file system takes the folder for one of its own.
//
//   .lamina-3f...-63d5be32-9a..../      mode 700; flock() keeps it while its process lives
//     mesh.su2                          a file, under the name that it will have
//     new/                              a folder that will take the place of another one
//     old/polyMesh/                     the one that it replaces, where the file system cannot exchange both at once
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lamina::core {

/// A temporary folder, which is removed with all that is in it. What is left under old/ gets its place back, unless
/// something else has taken that.
class TemporaryFolder {
public:
    /// Makes the folder beside `target`. Throws IoError about the target.
    explicit TemporaryFolder(const std::filesystem::path& target);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::string parent_, name_;
    std::filesystem::path path_;
    int lock_ = -1;  ///< descriptor of the folder; -1 where it is not locked
};

/// Removes the temporary folders that processes which no longer live have left beside `target`. Their locks tell: the
/// system lets go of them however a process ends. Folders of other users, of other machines and of file systems that
/// cannot lock them stay. Never throws.
void clear_folders_of_dead_processes(const std::filesystem::path& target) noexcept;

/// Removes the temporary folders of this process in a folder. Returns whether there were any. On Linux it allocates no
/// memory from the second call on. Never throws.
bool remove_own_temporary_folders(const char* folder) noexcept;

/// Returns the names of the files and folders in a folder; none where it cannot be read. Lack of memory is an
/// exception: std::filesystem::directory_iterator ends the process then.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// Keeps other processes that use it from exchanging files beside `target` at the same time, as far as the file system
/// can lock a folder: waits for them, but not for long, since anyone may lock it.
class ExchangeLock {
public:
    explicit ExchangeLock(const std::filesystem::path& target);
    ~ExchangeLock();
    ExchangeLock(const ExchangeLock&) = delete;
    ExchangeLock& operator=(const ExchangeLock&) = delete;

private:
    int folder_ = -1;
};

}  // namespace lamina::core
