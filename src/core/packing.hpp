// Values as bytes for another process of the same program on the same kind of machine.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lamina::core {

/// Puts values one after the other.
class Packer {
public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void put(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
    /// Puts a number in as few bytes as it needs.
    void put_short(std::uint64_t number) {
        for (; number >= 128; number >>= 7) put(static_cast<std::uint8_t>(number | 128));
        put(static_cast<std::uint8_t>(number));
    }
    /// Puts the number of values, and the values.
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void put_all(std::span<const T> values) {
        put_short(values.size());
        if (!values.empty()) bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    }
    /// Puts bytes without their number.
    void put_bytes(std::string_view bytes) { bytes_ += bytes; }
    void put_text(std::string_view text) { put_all<char>({text.data(), text.size()}); }
    /// Puts counts, of which many are small and many are 0, without the zeros at the end.
    void put_counts(std::span<const std::uint32_t> counts) {
        while (!counts.empty() && counts.back() == 0) counts = counts.first(counts.size() - 1);
        put_short(counts.size());
        for (std::size_t i = 0; i < counts.size(); ++i) {
            put_short(counts[i]);
            if (counts[i] != 0) continue;
            std::size_t more = 0;
            while (counts[i + 1] == 0) ++more, ++i;
            put_short(more);
        }
    }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// Takes them in the same order. Precondition of all functions: what is asked for was put there.
class Unpacker {
public:
    /// The bytes must outlive this object.
    explicit Unpacker(std::string_view bytes) : left_(bytes) {}

    bool at_end() const { return left_.empty(); }
    template <class T>
    requires std::is_trivially_copyable_v<T> T get() {
        T value;
        std::memcpy(&value, next(sizeof value), sizeof value);
        return value;
    }
    template <class T>
    requires std::is_trivially_copyable_v<T> std::vector<T> get_all() {
        std::vector<T> values(get_short());
        if (!values.empty()) std::memcpy(values.data(), next(values.size() * sizeof(T)), values.size() * sizeof(T));
        return values;
    }
    std::uint64_t get_short() {
        std::uint64_t number = 0;
        for (unsigned shift = 0;; shift += 7) {
            const auto byte = get<std::uint8_t>();
            number |= std::uint64_t{byte & 127u} << shift;
            if (byte < 128) return number;
        }
    }
    std::vector<std::uint32_t> get_counts() {
        std::vector<std::uint32_t> counts(get_short());
        for (std::size_t i = 0; i < counts.size(); ++i) {
            counts[i] = static_cast<std::uint32_t>(get_short());
            if (counts[i] == 0) i += get_short();
        }
        return counts;
    }
    std::string get_text() {
        const std::vector<char> text = get_all<char>();
        return {text.begin(), text.end()};
    }

private:
    std::string_view left_;

    const char* next(std::size_t bytes) {
        assert(bytes <= left_.size());
        const char* at = left_.data();
        left_.remove_prefix(bytes);
        return at;
    }
};

}  // namespace lamina::core
