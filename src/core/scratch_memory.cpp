#include "core/scratch_memory.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/unnamed_file.hpp"

#ifdef __linux__
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace lamina::core {

namespace fs = std::filesystem;

#ifdef __linux__

namespace {

/// Returns a folder on a disk where there is one: /tmp often lies in memory.
std::string scratch_folder() {
    if (const char* named = std::getenv("TMPDIR"); named != nullptr && *named != '\0') return named;
    return ::access("/var/tmp", W_OK) == 0 ? "/var/tmp" : fs::temp_directory_path().string();
}

[[noreturn]] void fail(const std::string& folder, int reason) {
    throw IoError(folder, std::string("cannot write a temporary file: ") + std::strerror(reason));
}

}  // namespace

ScratchMemory::ScratchMemory(std::size_t capacity, bool in_file) : capacity_(std::max<std::size_t>(capacity, 1)) {
    if (in_file) {
        folder_ = scratch_folder();
        file_ = open_unnamed_file(folder_);
        if (file_ < 0) fail(folder_, errno);
    }
    void* const mapped = ::mmap(nullptr, capacity_, PROT_READ | PROT_WRITE,
                                in_file ? MAP_SHARED : MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, file_, 0);
    if (mapped == MAP_FAILED) {
        if (file_ >= 0) ::close(file_);
        throw std::bad_alloc();
    }
    data_ = static_cast<char*>(mapped);
}

ScratchMemory::~ScratchMemory() {
    if (data_ != nullptr) ::munmap(data_, capacity_);
    if (file_ >= 0) ::close(file_);
}

void ScratchMemory::make_room(std::size_t bytes) {
    if (file_ < 0 || bytes <= room_) return;
    // A write behind the end of the file, or one that finds the disk full, would end the process.
    if (const int reason = ::posix_fallocate(file_, static_cast<off_t>(room_), static_cast<off_t>(bytes - room_)))
        fail(folder_, reason);
    room_ = bytes;
}

FileBytes::FileBytes(const fs::path& file) {
    struct stat status {};
    if (!is_standard_stream(file) && ::stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
        status.st_size > 0) {
        const auto size = static_cast<std::size_t>(status.st_size);
        if (const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC); descriptor >= 0) {
            void* const mapped = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
            ::close(descriptor);
            if (mapped != MAP_FAILED) {
                mapped_ = mapped;
                bytes_ = {static_cast<const char*>(mapped), size};
                (void)::madvise(mapped, size, MADV_SEQUENTIAL);
                return;
            }
        }
    }
    read_ = read_file(file);
    bytes_ = read_;
}

FileBytes::~FileBytes() {
    if (mapped_ != nullptr) ::munmap(mapped_, bytes_.size());
}

void FileBytes::forget_before(std::size_t place) const {
    constexpr std::size_t step = std::size_t{64} << 20;
    if (place < forgotten_) forgotten_ = 0;  // the file is gone through once more
    if (mapped_ == nullptr || place < forgotten_ + step) return;
    const std::size_t whole = (place - forgotten_) / step * step;
    // Only advice: the bytes are read from the file again where they are needed after all.
    (void)::madvise(static_cast<char*>(mapped_) + forgotten_, whole, MADV_DONTNEED);
    forgotten_ += whole;
}

#else

ScratchMemory::ScratchMemory(std::size_t capacity, bool) : data_(new char[capacity]()), capacity_(capacity) {}
ScratchMemory::~ScratchMemory() { delete[] data_; }
void ScratchMemory::make_room(std::size_t) {}

FileBytes::FileBytes(const fs::path& file) : read_(read_file(file)) { bytes_ = read_; }
FileBytes::~FileBytes() = default;
void FileBytes::forget_before(std::size_t) const {}

#endif

}  // namespace lamina::core
