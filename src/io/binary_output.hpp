// Fast writing of binary formats: records of one size are filled in parallel and written in order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <ostream>
#include <string>

#include "core/parallel.hpp"

namespace lamina::io {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

enum class ByteOrder { little, big };

/// Stores the bytes of the value at p, and returns the position behind them.
template <class T>
char* store(char* p, T value, ByteOrder order = ByteOrder::little) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    if (order == ByteOrder::big) std::reverse(bytes.begin(), bytes.end());
    std::memcpy(p, bytes.data(), sizeof value);
    return p + sizeof value;
}

/// Returns the number that store() has stored at p. Precondition: there are as many bytes.
template <class T>
T load(const char* p, ByteOrder order) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), p, sizeof(T));
    if (order == ByteOrder::big) std::reverse(bytes.begin(), bytes.end());
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
}

template <class T>
void write_value(std::ostream& out, T value, ByteOrder order = ByteOrder::little) {
    char bytes[sizeof value];
    store(bytes, value, order);
    out.write(bytes, sizeof value);
}

/// Writes n records. Record i is what fill(p, i) stores in the `size` bytes at p. Memory holds a bounded number of
/// records at a time.
template <class F>
void write_records(std::ostream& out, std::size_t n, std::size_t size, F&& fill) {
    constexpr std::size_t grain = 1 << 14;
    const std::size_t batch = std::min(n, grain * 4 * thread_count());
    std::string bytes(batch * size, '\0');
    for (std::size_t start = 0; start < n; start += batch) {
        const std::size_t count = std::min(batch, n - start);
        core::parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) fill(bytes.data() + i * size, start + i);
        });
        out.write(bytes.data(), static_cast<std::streamsize>(count * size));
    }
}

}  // namespace lamina::io
