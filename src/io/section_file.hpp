// A part of a file that is written before what stands in front of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <string_view>

namespace lamina::io {

/// A temporary file without a name, which vanishes with this object or with the process.
class SectionFile {
public:
    /// Opens the file on the disk of the target, or on that of the system's temporary files where the target is a device
    /// or standard output. For /dev/null bytes are counted alone. Throws IoError about the target.
    explicit SectionFile(const std::filesystem::path& target);
    ~SectionFile();
    SectionFile(const SectionFile&) = delete;
    SectionFile& operator=(const SectionFile&) = delete;

    /// Throws IoError about the target.
    void append(std::string_view bytes);
    std::size_t size() const { return size_; }
    /// Writes all bytes to the stream and gives their room on the disk back on the way. May be called once. Throws IoError
    /// about the target.
    void move_to(std::ostream& out);

private:
    std::filesystem::path target_;
    int file_ = -1;
    std::size_t size_ = 0;

    [[noreturn]] void fail(int reason) const;
};

/// Returns whether the file takes everything and keeps nothing.
bool is_null_device(const std::filesystem::path& file);

}  // namespace lamina::io
