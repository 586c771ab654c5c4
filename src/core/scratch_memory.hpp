// Large arrays that may lie in temporary files, and large files that are read in place: the system keeps of both what
// it has memory for.
#pragma once

#include <cassert>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <lamina/export.hpp>

namespace lamina::core {

/// Bytes that start as zeros, in memory or in a temporary file without a name, which vanishes with this object or with
/// the process. Where the system has no files that can be mapped, they lie in memory.
class LAMINA_EXPORT ScratchMemory {
public:
    ScratchMemory() = default;
    /// Reserves addresses for so many bytes, which take no room yet. Files lie in the folder that TMPDIR names, or in
    /// /var/tmp, or in that of the system's temporary files. Throws IoError; std::bad_alloc.
    ScratchMemory(std::size_t capacity, bool in_file);
    ~ScratchMemory();
    ScratchMemory(ScratchMemory&& other) noexcept { swap(other); }
    ScratchMemory& operator=(ScratchMemory&& other) noexcept {
        swap(other);
        return *this;
    }

    char* data() { return data_; }
    const char* data() const { return data_; }
    /// Makes room for the first `bytes` bytes, which may be used from then on. Throws IoError where the disk is full.
    void make_room(std::size_t bytes);

private:
    char* data_ = nullptr;
    std::size_t capacity_ = 0, room_ = 0;
    int file_ = -1;
    std::string folder_;

    void swap(ScratchMemory& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(capacity_, other.capacity_);
        std::swap(room_, other.room_);
        std::swap(file_, other.file_);
        std::swap(folder_, other.folder_);
    }
};

/// An array that grows up to a size that is known beforehand.
template <class T>
class ScratchArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    using value_type = T;

    explicit ScratchArray(bool in_file = false) : in_file_(in_file) {}

    /// Precondition: the array is empty.
    void reserve(std::size_t capacity) {
        assert(size_ == 0);
        capacity_ = capacity;
        memory_ = ScratchMemory(capacity * sizeof(T), in_file_);
    }
    /// Precondition: fewer entries than were reserved.
    void push_back(const T& value) {
        assert(size_ < capacity_);
        if (size_ == room_) {
            constexpr std::size_t step = std::size_t{1} << 22;
            room_ = capacity_ - room_ < step ? capacity_ : room_ + step;
            memory_.make_room(room_ * sizeof(T));
        }
        data()[size_++] = value;
    }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    void clear() { size_ = 0; }
    operator std::span<const T>() const {  // NOLINT(google-explicit-constructor): as a vector does
        return {reinterpret_cast<const T*>(memory_.data()), size_};
    }

private:
    bool in_file_;
    ScratchMemory memory_;
    std::size_t size_ = 0, capacity_ = 0, room_ = 0;

    T* data() { return reinterpret_cast<T*>(memory_.data()); }
};

/// The bytes of a file. Regular files are mapped where the system can; others are read.
class LAMINA_EXPORT FileBytes {
public:
    /// Throws IoError.
    explicit FileBytes(const std::filesystem::path& file);
    ~FileBytes();
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;

    std::string_view bytes() const { return bytes_; }
    /// Says that the bytes before this place will not be needed soon, so that they need no memory.
    void forget_before(std::size_t place) const;

private:
    std::string_view bytes_;
    std::string read_;  ///< holds the bytes where they are not mapped
    void* mapped_ = nullptr;
    mutable std::size_t forgotten_ = 0;
};

}  // namespace lamina::core
