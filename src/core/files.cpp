#include <lamina/files.hpp>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

#include <lamina/error.hpp>

#include "core/atomic_file.hpp"

namespace lamina {

using namespace core;

namespace fs = std::filesystem;

namespace {

std::string read_standard_input() {
    std::string bytes;
    constexpr std::size_t block = std::size_t{1} << 20;
    errno = 0;
    for (std::size_t got = block; got > 0;) {
        const std::size_t before = bytes.size();
        bytes.resize(before + block);
        got = std::fread(bytes.data() + before, 1, block, stdin);
        bytes.resize(before + got);
    }
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

std::string read_file(const fs::path& file) {
    if (is_standard_stream(file)) return read_standard_input();
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) throw IoError(file.string(), "cannot read: is a directory");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    std::string bytes;
    // The file is read block by block, since a pipe cannot tell its size.
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
