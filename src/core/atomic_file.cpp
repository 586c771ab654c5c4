#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

namespace lamina::core {

namespace fs = std::filesystem;

namespace {

/// Devices and pipes are no files that could be replaced.
bool is_device(const fs::path& file) {
    std::error_code ignored;
    const fs::file_type type = fs::status(file, ignored).type();
    return type == fs::file_type::character || type == fs::file_type::block || type == fs::file_type::fifo;
}

/// Beside the target, so that it can be renamed to it; the extension stays last, for writers that look at it.
fs::path temporary_beside(const fs::path& target, const char* what = "tmp") {
    fs::path temporary = target;
    temporary.replace_filename("." + target.stem().string() + "." + what + std::to_string(::getpid()) +
                               target.extension().string());
    return temporary;
}

/// Runs `work`; if it fails, `undo`, and what the file system complained of becomes an IoError about `target`.
void or_undo(const fs::path& target, const std::function<void()>& work, const std::function<void()>& undo) {
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

fs::path parent_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// Where symbolic links point to: that file is replaced, not the link. It need not exist yet.
fs::path behind_links(fs::path file) {
    std::error_code ignored;
    for (int steps = 0; steps < 40 && fs::is_symlink(file, ignored); ++steps)
        file = parent_of(file) / fs::read_symlink(file, ignored);
    return file;
}

}  // namespace

void write_files_atomically(std::span<const fs::path> targets,
                            const std::function<void(std::span<const fs::path>)>& write) {
    std::vector<fs::path> places, temporaries;
    for (const fs::path& target : targets) {
        if (is_device(target)) throw IoError(target.string(), "cannot write: not a file");
        places.push_back(behind_links(target));
        temporaries.push_back(temporary_beside(places.back()));
    }
    const auto work = [&] {
        write(temporaries);
        for (std::size_t i = 0; i < places.size(); ++i) fs::rename(temporaries[i], places[i]);
    };
    const auto undo = [&] {
        std::error_code ignored;
        for (const fs::path& temporary : temporaries) fs::remove(temporary, ignored);
    };
    or_undo(targets.front(), work, undo);
}

void write_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
    write_files_atomically({&target, 1}, [&](std::span<const fs::path> temporaries) { write(temporaries.front()); });
}

void write_folder_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
    const fs::path temporary = temporary_beside(target), replaced = temporary_beside(target, "old");
    std::vector<fs::path> made;  // the outermost first
    const auto work = [&] {
        for (fs::path above = parent_of(target); !fs::exists(above); above = parent_of(above))
            made.insert(made.begin(), above);
        for (const fs::path& folder : made) fs::create_directory(folder);
        fs::create_directory(temporary);
        write(temporary);
        if (fs::exists(target)) fs::rename(target, replaced);
        fs::rename(temporary, target);
    };
    const auto undo = [&] {
        std::error_code ignored;
        fs::remove_all(temporary, ignored);
        if (fs::exists(replaced, ignored)) fs::rename(replaced, target, ignored);
        for (auto folder = made.rbegin(); folder != made.rend(); ++folder) fs::remove(*folder, ignored);
    };
    or_undo(target, work, undo);
    std::error_code ignored;
    fs::remove_all(replaced, ignored);
}

void require_room(const fs::path& target, std::size_t bytes) {
    const fs::path trial = temporary_beside(target, "room");
    const int file = ::open(trial.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    const bool made = file >= 0 && (::fallocate(file, 0, 0, static_cast<off_t>(bytes)) == 0 || errno == EOPNOTSUPP);
    const int reason = errno;
    if (file >= 0) ::close(file);
    ::unlink(trial.c_str());
    if (!made) throw IoError(target.string(), std::string("cannot write: ") + std::strerror(reason));
}

void write_stream(const fs::path& file, const fs::path& target, const std::function<void(std::ostream&)>& write) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    if (out) write(out);
    out.close();
    if (!out) throw IoError(target.string(), std::string("cannot write: ") + std::strerror(errno ? errno : EIO));
}

void write_stream_atomically(const fs::path& target, const std::function<void(std::ostream&)>& write) {
    if (is_device(target)) return write_stream(target, target, write);
    write_atomically(target, [&](const fs::path& temporary) { write_stream(temporary, target, write); });
}

}  // namespace lamina::core

namespace lamina {

using namespace core;

void check_folder_writable(const fs::path& file) {
    const fs::path folder = parent_of(file);
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) throw IoError(file.string(), "cannot write: is a directory");
    if (!fs::exists(folder, ignored)) throw IoError(file.string(), "cannot write: its folder does not exist");
    if (!fs::is_directory(folder, ignored)) throw IoError(file.string(), "cannot write: its folder is a file");
    const bool writable =
        is_device(file) ? ::access(file.c_str(), W_OK) == 0 : ::access(folder.c_str(), W_OK | X_OK) == 0;
    if (!writable) throw IoError(file.string(), std::string("cannot write: ") + std::strerror(errno));
}

std::string read_file(const fs::path& file) {
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) throw IoError(file.string(), "cannot read: is a directory");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    std::string bytes;
    // By blocks: a pipe has no size to ask for.
    constexpr std::size_t block = std::size_t{1} << 20;
    while (in) {
        const std::size_t before = bytes.size();
        bytes.resize(before + block);
        in.read(bytes.data() + before, block);
        bytes.resize(before + static_cast<std::size_t>(in.gcount()));
    }
    if (!in.eof()) throw IoError(file.string(), std::string("cannot read: ") + std::strerror(errno ? errno : EIO));
    return bytes;
}

void write_file(const fs::path& file, const std::string& text) {
    write_stream_atomically(file, [&](std::ostream& out) { out << text; });
}

}  // namespace lamina
