#include <lamina/files.hpp>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

#include <lamina/error.hpp>
#include <lamina/limits.hpp>

#include "core/atomic_file.hpp"
#include "core/limits.hpp"

namespace lamina {

using namespace core;

namespace fs = std::filesystem;

namespace {

/// Reads a stream block by block, since a pipe cannot tell its size, and devices have no end. `read(to, bytes)` returns
/// how many bytes it has read.
template <class Read>
std::string read_blocks(const std::string& name, std::size_t max_bytes, const Read& read) {
    constexpr std::size_t block = std::size_t{1} << 20;
    std::size_t next_look = 256 * block;
    std::string bytes;
    for (std::size_t got = block; got > 0;) {
        const std::size_t before = bytes.size();
        if (before > max_bytes) throw IoError(name, "cannot read: is larger than " + core::memory_text(max_bytes));
        if (before >= next_look) {
            next_look *= 2;
            // A text that grows is copied once in a while, and then takes its room twice.
            if (const auto free = free_memory(); free && *free < next_look)
                throw IoError(name, "cannot read: is larger than " + core::memory_text(before) + ", and only " +
                                        core::memory_text(*free / block * block) + " of memory are free");
        }
        bytes.resize(before + block);
        got = read(bytes.data() + before, block);
        bytes.resize(before + got);
    }
    return bytes;
}

std::string read_standard_input(std::size_t max_bytes) {
    errno = 0;
    std::string bytes = read_blocks(input_name("-"), max_bytes,
                                    [](char* to, std::size_t size) { return std::fread(to, 1, size, stdin); });
    if (std::ferror(stdin) != 0)
        throw IoError(input_name("-"), std::string("cannot read: ") + std::strerror(errno ? errno : EIO));
    return bytes;
}

}  // namespace

bool is_standard_stream(const fs::path& file) { return file == "-"; }

std::string input_name(const fs::path& file) { return is_standard_stream(file) ? "standard input" : file.string(); }

void check_folder_writable(const fs::path& file) {
    if (is_standard_stream(file)) return;
    const fs::path folder = folder_of(file);
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) throw IoError(file.string(), "cannot write: is a directory");
    if (!fs::exists(folder, ignored)) throw IoError(file.string(), "cannot write: its folder does not exist");
    if (!fs::is_directory(folder, ignored)) throw IoError(file.string(), "cannot write: its folder is a file");
    const auto require_access = [&](const fs::path& path, int mode) {
        if (::access(path.c_str(), mode) != 0)
            throw IoError(file.string(), std::string("cannot write: ") + std::strerror(errno));
    };
    if (!is_device(file)) require_access(folder, W_OK | X_OK);
    if (fs::exists(file, ignored)) require_access(file, W_OK);
}

std::vector<fs::path> missing_folders(const fs::path& file) {
    std::vector<fs::path> missing;
    std::error_code ignored;
    for (fs::path above = file.parent_path(); !above.empty() && !fs::exists(above, ignored);
         above = above.parent_path())
        missing.insert(missing.begin(), above);
    return missing;
}

void create_folders_above(const fs::path& file) {
    if (file.parent_path().empty()) return;
    std::error_code failed;
    fs::create_directories(file.parent_path(), failed);
    if (failed) throw IoError(file.parent_path().string(), "cannot be created: " + failed.message());
}

std::string read_file(const fs::path& file, std::size_t max_bytes) {
    if (is_standard_stream(file)) return read_standard_input(max_bytes);
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) throw IoError(file.string(), "cannot read: is a directory");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    std::string bytes = read_blocks(file.string(), max_bytes, [&](char* to, std::size_t size) {
        in.read(to, static_cast<std::streamsize>(size));
        return static_cast<std::size_t>(in.gcount());
    });
    if (!in.eof()) throw IoError(file.string(), std::string("cannot read: ") + std::strerror(errno ? errno : EIO));
    return bytes;
}

void write_file(const fs::path& file, const std::string& text) {
    write_stream_atomically(file, [&](std::ostream& out) { out << text; });
}

}  // namespace lamina
