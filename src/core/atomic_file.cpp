#include "core/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <lamina/error.hpp>

namespace lamina {

namespace fs = std::filesystem;

void check_folder_writable(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) throw IoError(file.string(), "cannot write: is a directory");
    if (!fs::exists(folder, ignored)) throw IoError(file.string(), "cannot write: its folder does not exist");
    if (!fs::is_directory(folder, ignored)) throw IoError(file.string(), "cannot write: its folder is a file");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw IoError(file.string(), std::string("cannot write: ") + std::strerror(errno));
}

void write_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
    fs::path temporary = target;
    // The extension stays last, for writers that look at it.
    temporary.replace_filename("." + target.stem().string() + ".tmp" + std::to_string(::getpid()) +
                               target.extension().string());
    std::error_code ignored;
    try {
        write(temporary);
        fs::rename(temporary, target);
    } catch (const fs::filesystem_error& e) {
        fs::remove(temporary, ignored);
        throw IoError(target.string(), "cannot write: " + e.code().message());
    } catch (...) {
        fs::remove(temporary, ignored);
        throw;
    }
}

void write_stream_atomically(const fs::path& target, const std::function<void(std::ostream&)>& write) {
    write_atomically(target, [&](const fs::path& temporary) {
        errno = 0;
        std::ofstream out(temporary, std::ios::binary);
        if (out) write(out);
        out.close();
        if (!out) throw IoError(target.string(), std::string("cannot write: ") + std::strerror(errno ? errno : EIO));
    });
}

std::string read_whole_file(const fs::path& file) {
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

}  // namespace lamina
