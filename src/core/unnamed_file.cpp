#include "core/unnamed_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/atomic_file.hpp"

namespace lamina::core {

namespace fs = std::filesystem;

int open_unnamed_file(const fs::path& folder) {
#ifdef O_TMPFILE
    if (const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR, 0600); file >= 0) return file;
#endif
    // Some file systems have no files without names. This one loses its name at once, and lives until it is closed.
    std::string name = (folder / ".lamina-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file >= 0) ::unlink(name.c_str());
    return file;
}

UnnamedFile::UnnamedFile(const fs::path& target) : target_(target) {
    const bool beside = !is_standard_stream(target) && !is_device(target);
    file_ = open_unnamed_file(beside ? folder_of(target) : fs::temp_directory_path());
    if (file_ < 0) fail(errno);
}

UnnamedFile::~UnnamedFile() {
    if (file_ >= 0) ::close(file_);
}

void UnnamedFile::fail(int reason) const {
    throw IoError(target_.string(), std::string("cannot write: ") + std::strerror(reason));
}

void UnnamedFile::write_at(std::size_t offset, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail(written < 0 ? errno : EIO);
        bytes.remove_prefix(static_cast<std::size_t>(written));
        offset += static_cast<std::size_t>(written);
    }
}

void UnnamedFile::read_at(std::size_t offset, std::span<char> bytes) const {
    while (!bytes.empty()) {
        const ssize_t read = ::pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (read < 0 && errno == EINTR) continue;
        if (read <= 0) fail(read < 0 ? errno : EIO);
        bytes = bytes.subspan(static_cast<std::size_t>(read));
        offset += static_cast<std::size_t>(read);
    }
}

void UnnamedFile::release([[maybe_unused]] std::size_t offset, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(FALLOC_FL_PUNCH_HOLE)
    // Where the file system cannot, the bytes keep their room until the file is closed.
    static_cast<void>(::fallocate(file_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset),
                                  static_cast<off_t>(bytes)));
#endif
}

}  // namespace lamina::core
