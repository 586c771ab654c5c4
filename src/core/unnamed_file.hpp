// Bytes that wait on the disk for a place in a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include <lamina/export.hpp>

namespace lamina::core {

/// Opens a file without a name in a folder, to be read and written. Returns its descriptor, or -1 with the reason in
/// errno.
int open_unnamed_file(const std::filesystem::path& folder);

/// A temporary file without a name, which vanishes with this object or with the process.
class LAMINA_EXPORT UnnamedFile {
public:
    /// Opens the file on the disk of the target, or on that of the system's temporary files where the target is a
    /// device or standard output. Throws IoError about the target.
    explicit UnnamedFile(const std::filesystem::path& target);
    ~UnnamedFile();
    UnnamedFile(const UnnamedFile&) = delete;
    UnnamedFile& operator=(const UnnamedFile&) = delete;

    /// Write or read bytes at a place; any thread may do so. Throw IoError about the target.
    void write_at(std::size_t offset, std::string_view bytes);
    void read_at(std::size_t offset, std::span<char> bytes) const;
    /// Gives the room of bytes on the disk back, where the file system can.
    void release(std::size_t offset, std::size_t bytes);

private:
    std::filesystem::path target_;
    int file_ = -1;

    [[noreturn]] void fail(int reason) const;
};

}  // namespace lamina::core
