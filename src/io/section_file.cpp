#include "io/section_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <vector>

namespace lamina::io {

namespace fs = std::filesystem;

bool is_null_device(const fs::path& file) {
    // fs::equivalent() does not compare devices.
    struct stat one {
    }, other{};
    return ::stat(file.c_str(), &one) == 0 && ::stat("/dev/null", &other) == 0 && S_ISCHR(one.st_mode) &&
           one.st_rdev == other.st_rdev;
}

SectionFile::SectionFile(const fs::path& target) {
    if (!is_null_device(target)) file_ = std::make_unique<core::UnnamedFile>(target);
}

void SectionFile::append(std::string_view bytes) {
    if (file_) file_->write_at(size_, bytes);
    size_ += bytes.size();
}

void SectionFile::move_to(std::ostream& out) {
    constexpr std::size_t block = std::size_t{8} << 20;
    if (!file_) return;
    std::vector<char> buffer(std::min(block, size_));
    for (std::size_t at = 0; at < size_ && out;) {
        const std::size_t read = std::min(buffer.size(), size_ - at);
        file_->read_at(at, {buffer.data(), read});
        out.write(buffer.data(), static_cast<std::streamsize>(read));
        file_->release(at, read);
        at += read;
    }
}

}  // namespace lamina::io
