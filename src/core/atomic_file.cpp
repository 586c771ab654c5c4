#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

namespace lamina::core {

namespace fs = std::filesystem;

namespace {

/// The purposes of temporary files: the new content, the old folder, and a trial of the room on the disk.
constexpr const char *new_purpose = "tmp", *replaced_purpose = "old", *room_purpose = "room";

/// Returns a hidden name beside the target, which is on the same file system and can hence be renamed to it. The
/// extension stays last, since some writers choose the format by it.
fs::path temporary_beside(const fs::path& target, const char* purpose = new_purpose) {
    // fs::path::replace_filename() of GCC 12's library crashes where it finds no memory.
    const std::string& path = target.native();
    return path.substr(0, path.rfind('/') + 1) + "." + target.stem().string() + "." + purpose +
           std::to_string(::getpid()) + target.extension().string();
}

/// Removes a file or a folder with all that is in it. It tries again where it finds no memory, since an exception that
/// is on its way frees more.
void remove_quietly(const fs::path& path) noexcept {
    for (int attempt = 0; attempt < 3; ++attempt) {
        try {
            std::error_code failed;
            fs::remove_all(path, failed);
            if (!failed) return;
        } catch (...) {
            // The next attempt may succeed.
        }
    }
}

/// Calls work(). If it fails, calls undo() and throws; failures of the file system become an IoError about `target`.
void work_or_undo(const fs::path& target, const std::function<void()>& work, const std::function<void()>& undo) {
    try {
        work();
    } catch (const fs::filesystem_error& e) {
        undo();
        throw IoError(target.string(), "cannot write: " + e.code().message());
    } catch (...) {
        undo();
        throw;
    }
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

}  // namespace

bool is_device(const fs::path& file) {
    std::error_code ignored;
    const fs::file_type type = fs::status(file, ignored).type();
    return type == fs::file_type::character || type == fs::file_type::block || type == fs::file_type::fifo;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

void write_files_atomically(std::span<const fs::path> targets,
                            const std::function<void(std::span<const fs::path>)>& write) {
    std::vector<fs::path> files, temporaries;
    for (const fs::path& target : targets) {
        if (is_device(target)) throw IoError(target.string(), "cannot write: not a file");
        files.push_back(behind_links(target));
        temporaries.push_back(temporary_beside(files.back()));
    }
    const auto work = [&] {
        write(temporaries);
        for (std::size_t i = 0; i < files.size(); ++i) fs::rename(temporaries[i], files[i]);
    };
    const auto undo = [&] {
        std::error_code ignored;
        for (const fs::path& temporary : temporaries) fs::remove(temporary, ignored);
    };
    work_or_undo(targets.front(), work, undo);
}

void write_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
    write_files_atomically({&target, 1}, [&](std::span<const fs::path> temporaries) { write(temporaries.front()); });
}

void write_folder_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
    const fs::path temporary = temporary_beside(target), replaced = temporary_beside(target, replaced_purpose);
    std::vector<fs::path> created;  // missing folders above the target, the outermost one first
    const auto work = [&] {
        created = missing_folders(target);
        for (const fs::path& folder : created) fs::create_directory(folder);
        fs::create_directory(temporary);
        write(temporary);
        if (fs::exists(target)) fs::rename(target, replaced);
        fs::rename(temporary, target);
    };
    const auto undo = [&] {
        std::error_code ignored;
        remove_quietly(temporary);
        if (fs::exists(replaced, ignored)) fs::rename(replaced, target, ignored);
        for (; !created.empty(); created.pop_back()) fs::remove(created.back(), ignored);
    };
    work_or_undo(target, work, undo);
    remove_quietly(replaced);
}

#ifdef __linux__
void reserve_room(const fs::path& file, const fs::path& target, std::size_t bytes) {
    const int opened = ::open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0666);
    const bool has_room =
        opened >= 0 && (::fallocate(opened, 0, 0, static_cast<off_t>(bytes)) == 0 || errno == EOPNOTSUPP);
    const int reason = errno;
    if (opened >= 0) ::close(opened);
    if (!has_room) throw IoError(target.string(), std::string("cannot write: ") + std::strerror(reason));
}

void require_room(const fs::path& target, std::size_t bytes) {
    const fs::path trial = temporary_beside(target, room_purpose);
    const auto remove = [&] { ::unlink(trial.c_str()); };
    work_or_undo(
        target, [&] { reserve_room(trial, target, bytes); }, remove);
    remove();
}
#else
// Elsewhere nothing reserves room without writing, so a full disk shows only while the file is written.
void require_room(const fs::path&, std::size_t) {}
void reserve_room(const fs::path& file, const fs::path& target, std::size_t) {
    write_stream(file, target, [](std::ostream&) {});
}
#endif

void write_stream(const fs::path& file, const fs::path& target, const std::function<void(std::ostream&)>& write) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    if (out) write(out);
    out.close();
    if (!out) throw IoError(target.string(), std::string("cannot write: ") + std::strerror(errno ? errno : EIO));
}

namespace {

void write_standard_output(const std::function<void(std::ostream&)>& write) {
    errno = 0;
    write(std::cout);
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0)
        throw IoError("standard output", std::string("cannot write: ") + std::strerror(errno ? errno : EIO));
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

namespace {

/// Returns whether there were any.
bool remove_temporaries_of(const fs::path& target) {
    std::error_code ignored;
    bool found = false;
    for (const fs::path& temporary :
         {temporary_beside(behind_links(target)), temporary_beside(target), temporary_beside(target, room_purpose)}) {
        const auto removed = fs::remove_all(temporary, ignored);
        found = found || (!ignored && removed > 0);
    }
    const fs::path replaced = temporary_beside(target, replaced_purpose);
    if (!fs::exists(replaced, ignored)) return found;
    if (fs::exists(target, ignored))
        fs::remove_all(replaced, ignored);
    else
        fs::rename(replaced, target, ignored);
    return true;
}

}  // namespace

std::vector<fs::path> temporaries_of(std::span<const fs::path> targets) {
    std::vector<fs::path> temporaries;
    for (const fs::path& target : targets) temporaries.push_back(temporary_beside(behind_links(target)));
    return temporaries;
}

bool remove_temporaries(std::span<const fs::path> targets) noexcept {
    bool found = false;
    for (const fs::path& target : targets) {
        try {
            found = remove_temporaries_of(target) || found;
        } catch (...) {
            // Only a lack of memory throws here. The other targets may still be cleaned.
        }
    }
    return found;
}

}  // namespace lamina
