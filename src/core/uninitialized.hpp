// An array whose entries start uninitialised, for storage that is written entry by entry before it is read.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

namespace lamina::core {

template <class T>
class UninitializedArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    UninitializedArray() = default;
    explicit UninitializedArray(std::size_t size) : data_(std::make_unique_for_overwrite<T[]>(size)), size_(size) {}

    std::size_t size() const { return size_; }
    /// Drops the entries from `size` on; the storage stays.
    void shrink(std::size_t size) {
        assert(size <= size_);
        size_ = size;
    }
    T* data() { return data_.get(); }
    T* begin() { return data_.get(); }
    T* end() { return data_.get() + size_; }
    const T* begin() const { return data_.get(); }
    const T* end() const { return data_.get() + size_; }
    T& operator[](std::size_t i) { return data_[i]; }
    const T& operator[](std::size_t i) const { return data_[i]; }
    std::span<const T> all() const { return {data_.get(), size_}; }

private:
    std::unique_ptr<T[]> data_;
    std::size_t size_ = 0;
};

}  // namespace lamina::core
