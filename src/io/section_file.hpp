// A part of a file that is written before what stands in front of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string_view>

#include "core/unnamed_file.hpp"

namespace lamina::io {

/// A part of a file that waits on the disk, without a name, until it can be written.
class SectionFile {
public:
    /// Opens a file as core::UnnamedFile does. For /dev/null, bytes are counted alone. Throws IoError about the target.
    explicit SectionFile(const std::filesystem::path& target);

    /// Throws IoError about the target.
    void append(std::string_view bytes);
    std::size_t size() const { return size_; }
    /// Writes all bytes to the stream and gives their room on the disk back on the way. May be called once. Throws
    /// IoError about the target.
    void move_to(std::ostream& out);

private:
    std::unique_ptr<core::UnnamedFile> file_;  ///< null: bytes are counted alone
    std::size_t size_ = 0;
};

/// Returns whether the file takes everything and keeps nothing.
bool is_null_device(const std::filesystem::path& file);

}  // namespace lamina::io
