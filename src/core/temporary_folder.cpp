#include "core/temporary_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/file.h>
#include <sys/syscall.h>
#endif

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <lamina/error.hpp>

#include "core/atomic_file.hpp"

namespace lamina::core {

namespace fs = std::filesystem;

namespace {

// --- Names

constexpr std::string_view name_start = ".lamina-";
constexpr std::size_t process_digits = 12, boot_digits = 8, random_digits = 8;
constexpr std::size_t boot_at = name_start.size() + process_digits + 1;
constexpr std::size_t name_length = boot_at + boot_digits + 1 + random_digits;
/// Stands for the identity of the system where nothing tells it, or where locks tell nothing.
constexpr std::string_view no_boot = "00000000";

/// Returns random hexadecimal digits. No mesh depends on them.
std::string random_text(std::size_t digits) {
    std::random_device random;
    std::string text;
    while (text.size() < digits) text += "0123456789abcdef"[random() % 16];
    return text;
}

/// Returns the beginning of the names of this process's folders, up to the identity of the system.
const std::string& own_start() {
    static const std::string start = std::string(name_start) + random_text(process_digits) + "-";
    return start;
}

/// Returns the first digits of the identity of the running system, which it gives itself at its start.
const std::string& boot() {
    static const std::string identity = [] {
        std::string text;
        std::ifstream("/proc/sys/kernel/random/boot_id") >> text;
        text.resize(std::min(text.size(), boot_digits));
        const bool known =
            text.size() == boot_digits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
        return known ? text : std::string(no_boot);
    }();
    return identity;
}

// --- Entries of folders, by system calls alone: a signal may have stopped the threads that hold the locks of memory

constexpr int folder_flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

/// Calls f(name) for each entry of an open folder but "." and "..".
template <class F>
void for_each_entry(int folder, F&& f) {
    const auto call = [&](const char* name) {
        if (std::strcmp(name, ".") != 0 && std::strcmp(name, "..") != 0) f(name);
    };
#ifdef __linux__
    alignas(dirent64) char entries[4096];
    for (long bytes; (bytes = ::syscall(SYS_getdents64, folder, entries, sizeof entries)) > 0;)
        for (long at = 0; at < bytes;) {
            const auto* entry = reinterpret_cast<const dirent64*>(entries + at);
            at += entry->d_reclen;
            call(entry->d_name);
        }
#else
    DIR* const listed = ::fdopendir(::dup(folder));
    if (listed == nullptr) return;
    while (const dirent* entry = ::readdir(listed)) call(entry->d_name);
    ::closedir(listed);
#endif
}

/// Calls f(folder, name) for each entry of the folder of this name, with the descriptor of the folder.
template <class F>
void for_each_entry_in(const char* path, F&& f) {
    const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    for_each_entry(folder, [&](const char* name) { f(folder, name); });
    ::close(folder);
}

/// Opens a folder, which need not be readable, for calls that name its entries.
int open_folder(const char* path) {
#ifdef O_PATH
    return ::open(path, O_PATH | O_DIRECTORY | O_CLOEXEC);
#else
    return ::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
#endif
}

/// Removes a file, or a folder with all that is in it, up to the depth that temporary folders have.
void remove_entry(int parent, const char* name, int depth = 4) {
    if (::unlinkat(parent, name, 0) == 0 || depth == 0) return;
    const int folder = ::openat(parent, name, folder_flags);
    if (folder < 0) return;
    for_each_entry(folder, [&](const char* inner) { remove_entry(folder, inner, depth - 1); });
    ::close(folder);
    ::unlinkat(parent, name, AT_REMOVEDIR);
}

/// Gives what a temporary folder keeps under old/ its place in `parent` back, where that is free.
void restore_replaced(int parent, int temporary) {
    const int old = ::openat(temporary, "old", folder_flags);
    if (old < 0) return;
    for_each_entry(old, [&](const char* name) {
        if (::faccessat(parent, name, F_OK, AT_SYMLINK_NOFOLLOW) != 0) ::renameat(old, name, parent, name);
    });
    ::close(old);
}

/// Removes a temporary folder in `parent`.
void remove_temporary(int parent, const char* name) {
    if (const int temporary = ::openat(parent, name, folder_flags); temporary >= 0) {
        restore_replaced(parent, temporary);
        ::close(temporary);
    }
    remove_entry(parent, name);
}

// --- Locks

#ifdef __linux__
/// Opens a folder and locks it. Returns its descriptor, or -1 with errno: EWOULDBLOCK where another process holds the
/// lock.
int open_locked(int parent, const char* name) {
    const int folder = ::openat(parent, name, folder_flags);
    if (folder < 0 || ::flock(folder, LOCK_EX | LOCK_NB) == 0) return folder;
    const int reason = errno;
    ::close(folder);
    errno = reason;
    return -1;
}

/// Opens a folder that was just made, and locks it. Returns -1 where that fails, with errno; EWOULDBLOCK where another
/// process has taken it for that of a dead one before it was locked.
int lock_new_folder(const fs::path& path) {
    const int folder = open_locked(AT_FDCWD, path.c_str());
    if (folder < 0) {
        if (errno == ENOENT) errno = EWOULDBLOCK;
        return -1;
    }
    struct stat opened {
    }, named{};
    if (::fstat(folder, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
        opened.st_dev == named.st_dev)
        return folder;
    ::close(folder);
    errno = EWOULDBLOCK;
    return -1;
}

void clear_if_dead(int parent, const char* name) {
    const std::string_view text = name;
    if (text.size() != name_length || !text.starts_with(name_start) || text.substr(boot_at, boot_digits) != boot())
        return;
    const int folder = open_locked(parent, name);
    if (folder < 0) return;
    struct stat status {};
    if (::fstat(folder, &status) == 0 && status.st_uid == ::geteuid()) remove_temporary(parent, name);
    ::close(folder);
}
#endif

}  // namespace

TemporaryFolder::TemporaryFolder(const fs::path& target) : parent_(folder_of(target).string()) {
    constexpr int max_attempts = 100;
    bool lockable = boot() != no_boot;
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
        // Folders that cannot be locked have names that no process clears.
        name_ = own_start() + (lockable ? boot() : std::string(no_boot)) + "-" + random_text(random_digits);
        path_ = parent_ + "/" + name_;
        if (::mkdir(path_.c_str(), 0700) != 0) {
            if (errno == EEXIST) continue;
            throw IoError(target.string(), std::string("cannot write: ") + std::strerror(errno));
        }
#ifdef __linux__
        if (!lockable || (lock_ = lock_new_folder(path_)) >= 0) return;
        lockable = errno == EWOULDBLOCK;
        ::rmdir(path_.c_str());
#else
        return;
#endif
    }
    throw IoError(target.string(), "cannot write: no name for a temporary folder is free");
}

TemporaryFolder::~TemporaryFolder() {
    if (const int parent = open_folder(parent_.c_str()); parent >= 0) {
        remove_temporary(parent, name_.c_str());
        ::close(parent);
    }
    if (lock_ >= 0) ::close(lock_);
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    const int opened = ::open(folder.c_str(), folder_flags);
    if (opened < 0) return names;
    try {
        for_each_entry(opened, [&](const char* name) { names.emplace_back(name); });
    } catch (...) {
        ::close(opened);
        throw;
    }
    ::close(opened);
    return names;
}

bool remove_own_temporary_folders(const char* folder) noexcept {
    try {
        const std::string& own = own_start();
        bool found = false;
        for_each_entry_in(folder, [&](int parent, const char* name) {
            if (std::strncmp(name, own.c_str(), own.size()) != 0) return;
            found = true;
            remove_temporary(parent, name);
        });
        return found;
    } catch (...) {
        return false;  // a process without a name of its own has made no folder
    }
}

#ifdef __linux__
void clear_folders_of_dead_processes(const fs::path& target) noexcept {
    try {
        if (boot() != no_boot) for_each_entry_in(folder_of(target).c_str(), clear_if_dead);
    } catch (...) {
        // Where memory is lacking, they wait for the next process.
    }
}

ExchangeLock::ExchangeLock(const fs::path& target) {
    constexpr int max_attempts = 100;
    constexpr std::chrono::milliseconds wait(10);
    folder_ = ::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    for (int attempt = 0; folder_ >= 0 && attempt < max_attempts; ++attempt) {
        if (::flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
        std::this_thread::sleep_for(wait);
    }
}

ExchangeLock::~ExchangeLock() {
    if (folder_ >= 0) ::close(folder_);
}
#else
void clear_folders_of_dead_processes(const fs::path&) noexcept {}
ExchangeLock::ExchangeLock(const fs::path&) {}
ExchangeLock::~ExchangeLock() = default;
#endif

}  // namespace lamina::core
