#include "io/section_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/atomic_file.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

bool is_null_device(const fs::path& file) {
    // fs::equivalent() does not compare devices.
    struct stat one {
    }, other{};
    return ::stat(file.c_str(), &one) == 0 && ::stat("/dev/null", &other) == 0 && S_ISCHR(one.st_mode) &&
           one.st_rdev == other.st_rdev;
}

SectionFile::SectionFile(const fs::path& target) : target_(target) {
    if (is_null_device(target)) return;
    const bool beside = !is_standard_stream(target) && !core::is_device(target);
    const fs::path folder = beside ? core::folder_of(target) : fs::temp_directory_path();
#ifdef O_TMPFILE
    file_ = ::open(folder.c_str(), O_TMPFILE | O_RDWR, 0600);
    if (file_ >= 0) return;
#endif
    // Some file systems have no files without names. This one loses its name at once, and lives until it is closed.
    std::string name = (folder / ".lamina-XXXXXX").string();
    file_ = ::mkstemp(name.data());
    if (file_ < 0) fail(errno);
    ::unlink(name.c_str());
}

SectionFile::~SectionFile() {
    if (file_ >= 0) ::close(file_);
}

void SectionFile::fail(int reason) const {
    throw IoError(target_.string(), std::string("cannot write: ") + std::strerror(reason));
}

void SectionFile::append(std::string_view bytes) {
    size_ += bytes.size();
    while (file_ >= 0 && !bytes.empty()) {
        const ssize_t written = ::write(file_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail(written < 0 ? errno : EIO);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void SectionFile::move_to(std::ostream& out) {
    constexpr std::size_t block = std::size_t{8} << 20;
    if (file_ < 0) return;
    std::vector<char> buffer(std::min(block, size_));
    for (std::size_t at = 0; at < size_ && out;) {
        const ssize_t read = ::pread(file_, buffer.data(), std::min(buffer.size(), size_ - at), static_cast<off_t>(at));
        if (read < 0 && errno == EINTR) continue;
        if (read <= 0) fail(read < 0 ? errno : EIO);
        out.write(buffer.data(), read);
#if defined(__linux__) && defined(FALLOC_FL_PUNCH_HOLE)
        // Where the file system cannot, the bytes keep their room until the file is closed.
        static_cast<void>(::fallocate(file_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(at), read));
#endif
        at += static_cast<std::size_t>(read);
    }
}

}  // namespace lamina::io
