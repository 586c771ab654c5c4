#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/temporary_folder.hpp"

namespace lamina::core {

namespace fs = std::filesystem;

namespace {

/// Calls work(); failures of the file system become an IoError about `target`.
void work_on(const fs::path& target, const std::function<void()>& work) {
    try {
        work();
    } catch (const fs::filesystem_error& e) {
        throw IoError(target.string(), "cannot write: " + e.code().message());
    }
}

[[noreturn]] void fail_to_write(const fs::path& target, int reason) {
    throw IoError(target.string(), std::string("cannot write: ") + std::strerror(reason));
}

/// Returns the file that a symbolic link stands for, so that this file is replaced and not the link. It need not exist
/// yet.
fs::path behind_links(fs::path file) {
    constexpr int max_links = 40;  // as many as Linux follows; links may form a cycle
    std::error_code ignored;
    for (int links = 0; links < max_links && fs::is_symlink(file, ignored); ++links)
        file = folder_of(file) / fs::read_symlink(file, ignored);
    return file;
}

/// Gives a new file or folder the owner and the permissions of the one that it will replace, if there is one. Where the
/// group cannot be kept, its members may do what others may.
void keep_permissions(const fs::path& target, const fs::path& replacement) {
    struct stat old {
    }, made{};
    if (::stat(target.c_str(), &old) != 0 || ::stat(replacement.c_str(), &made) != 0) return;
    constexpr mode_t all = 0777, others = 07;
    constexpr unsigned group_shift = 3;
    mode_t mode = old.st_mode & all;
    const bool same_owners = old.st_uid == made.st_uid && old.st_gid == made.st_gid;
    if (!same_owners && ::chown(replacement.c_str(), old.st_uid, old.st_gid) != 0 && old.st_gid != made.st_gid &&
        ::chown(replacement.c_str(), static_cast<uid_t>(-1), old.st_gid) != 0)
        mode &= ~(others << group_shift) | (mode & others) << group_shift;
    // A file system without permissions may refuse; then there are none to keep.
    static_cast<void>(::chmod(replacement.c_str(), mode));
}

/// Lets a folder take the place of another one, which goes into `temporary`.
void put_in_place(const fs::path& folder, const fs::path& target, const fs::path& temporary) {
    constexpr int max_attempts = 100;  // other processes may write the same folder
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
        if (::rename(folder.c_str(), target.c_str()) == 0) return;  // there is none, or an empty one
        if (errno != EEXIST && errno != ENOTEMPTY && errno != ENOTDIR) break;
#ifdef RENAME_EXCHANGE
        if (::renameat2(AT_FDCWD, folder.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) return;
        if (errno == ENOENT) continue;
        if (errno != EINVAL && errno != ENOSYS && errno != EOPNOTSUPP) break;
#endif
        const fs::path old = temporary / "old";
        fs::remove_all(old);
        fs::create_directory(old);
        if (::rename(target.c_str(), (old / target.filename()).c_str()) != 0 && errno != ENOENT) break;
    }
    fail_to_write(target, errno);
}

}  // namespace

bool is_device(const fs::path& file) {
    std::error_code ignored;
    const fs::file_type type = fs::status(file, ignored).type();
    return type == fs::file_type::character || type == fs::file_type::block || type == fs::file_type::fifo;
}

NewFolders::~NewFolders() {
    std::error_code ignored;
    for (; !created_.empty(); created_.pop_back()) fs::remove(created_.back(), ignored);  // fails unless it is empty
}

void NewFolders::create_above(const fs::path& file) {
    for (const fs::path& folder : missing_folders(file)) {
        std::error_code failed;
        if (fs::create_directory(folder, failed)) created_.push_back(folder);
        if (failed) throw IoError(folder.string(), "cannot be created: " + failed.message());
    }
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

void write_files_atomically(std::span<const fs::path> targets,
                            const std::function<void(std::span<const fs::path>)>& write) {
    std::vector<fs::path> files, temporaries;
    std::map<fs::path, TemporaryFolder> folders;
    for (const fs::path& target : targets) {
        if (is_device(target)) throw IoError(target.string(), "cannot write: not a file");
        files.push_back(behind_links(target));
        const fs::path beside = folder_of(files.back());
        if (!folders.contains(beside)) clear_folders_of_dead_processes(files.back());
        temporaries.push_back(folders.try_emplace(beside, files.back()).first->second.path() / files.back().filename());
    }
    work_on(targets.front(), [&] {
        write(temporaries);
        for (std::size_t i = 0; i < files.size(); ++i) keep_permissions(files[i], temporaries[i]);
        // Of two processes that write the same files, the later one leaves all of its own.
        std::optional<ExchangeLock> lock;
        if (files.size() > 1) lock.emplace(files.front());
        for (std::size_t i = 0; i < files.size(); ++i) fs::rename(temporaries[i], files[i]);
    });
}

void write_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
    write_files_atomically({&target, 1}, [&](std::span<const fs::path> temporaries) { write(temporaries.front()); });
}

void write_folder_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
    NewFolders created;
    work_on(target, [&] {
        created.create_above(target);
        clear_folders_of_dead_processes(target);
        const TemporaryFolder temporary(target);
        const fs::path folder = temporary.path() / "new";
        fs::create_directory(folder);
        write(folder);
        for (const std::string& file : names_in(folder)) keep_permissions(target / file, folder / file);
        keep_permissions(target, folder);
        put_in_place(folder, target, temporary.path());
    });
    created.keep();
}

#ifdef __linux__
void reserve_room(const fs::path& file, const fs::path& target, std::size_t bytes) {
    const int opened = ::open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0666);
    const bool has_room =
        opened >= 0 && (::fallocate(opened, 0, 0, static_cast<off_t>(bytes)) == 0 || errno == EOPNOTSUPP);
    const int reason = errno;
    if (opened >= 0) ::close(opened);
    if (!has_room) fail_to_write(target, reason);
}
#else
// Elsewhere nothing reserves room without writing, so a full disk shows only while the file is written.
void reserve_room(const fs::path& file, const fs::path& target, std::size_t) {
    write_stream(file, target, [](std::ostream&) {});
}
#endif

void write_stream(const fs::path& file, const fs::path& target, const std::function<void(std::ostream&)>& write) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    if (out) write(out);
    out.close();
    if (!out) fail_to_write(target, errno ? errno : EIO);
}

namespace {

void write_standard_output(const std::function<void(std::ostream&)>& write) {
    errno = 0;
    write(std::cout);
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0) fail_to_write("standard output", errno ? errno : EIO);
}

}  // namespace

void write_stream_atomically(const fs::path& target, const std::function<void(std::ostream&)>& write) {
    if (is_standard_stream(target)) return write_standard_output(write);
    if (is_device(target)) return write_stream(target, target, write);
    write_atomically(target, [&](const fs::path& temporary) { write_stream(temporary, target, write); });
}

}  // namespace lamina::core

namespace lamina {

using namespace core;

std::vector<fs::path> folders_of_temporaries(std::span<const fs::path> targets) {
    std::vector<fs::path> folders;
    for (const fs::path& target : targets) {
        folders.push_back(folder_of(target));
        folders.push_back(folder_of(behind_links(target)));
    }
    std::sort(folders.begin(), folders.end());
    folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
    return folders;
}

bool remove_temporaries_in(const char* folder) noexcept { return remove_own_temporary_folders(folder); }

}  // namespace lamina
