// Formats that hold the same numbers in ASCII or binary: one reader for both.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "io/binary_output.hpp"

namespace lamina::io {

/// Words and numbers of a file that is ASCII or, from some place on, binary.
class ByteReader {
public:
    ByteReader(const std::string& bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

    void be_binary(ByteOrder order) {
        binary_ = true;
        order_ = order;
    }
    bool binary() const { return binary_; }

    /// The next word, whatever the mode; empty at the end.
    std::string_view word() {
        skip_space();
        const std::size_t first = at_;
        while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
        return std::string_view(bytes_).substr(first, at_ - first);
    }
    /// The rest of the line without blanks round it; what follows is the next line's first byte.
    std::string_view rest_of_line() {
        const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
        std::string_view rest = std::string_view(bytes_).substr(at_, end - at_);
        at_ = std::min(end + 1, bytes_.size());
        while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
        while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
        return rest;
    }
    /// A number in figures, whatever the mode.
    template <class T>
    T figures(const char* what) {
        const std::string_view text = word();
        T value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (text.empty() || error != std::errc{} || end != text.data() + text.size())
            fail(fmt::format("{} expected, found '{}'", what, shown(text)));
        return value;
    }
    template <class T>
    T number(const char* what) {
        if (!binary_) return figures<T>(what);
        if (bytes_.size() - at_ < sizeof(T)) fail(fmt::format("the file ends where {} is expected", what));
        char stored[sizeof(T)];
        std::memcpy(stored, bytes_.data() + at_, sizeof stored);
        if (order_ == ByteOrder::big) std::reverse(stored, stored + sizeof stored);
        T value;
        std::memcpy(&value, stored, sizeof value);
        at_ += sizeof value;
        return value;
    }
    /// A number of things to come, each of at least this many bytes in a binary file and two in an ASCII one: absurd
    /// counts are refused before memory is asked for.
    std::size_t count(std::size_t value, std::size_t bytes_each, const char* what) {
        if (value > (bytes_.size() - at_) / (binary_ ? bytes_each : 2) + 1)
            fail(fmt::format("{}: {}, but the file is shorter than that", what, value));
        return value;
    }
    void expect(std::string_view expected) {
        if (const std::string_view found = word(); found != expected)
            fail(fmt::format("{} expected, found '{}'", expected, shown(found)));
    }
    void skip_behind(const std::string& text) {
        const std::size_t found = bytes_.find(text, at_);
        if (found == std::string::npos) fail(fmt::format("the file ends without {}", text));
        at_ = found + text.size();
    }
    bool at_end() {
        if (!binary_) skip_space();
        return at_ == bytes_.size();
    }
    [[noreturn]] void fail(const std::string& reason) const {
        // Lines mean nothing behind binary data.
        const auto line = 1 + std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
        throw InputError({file_, binary_ ? 0 : static_cast<std::size_t>(line), {}}, reason);
    }

private:
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
    void skip_space() {
        while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
    }
    static std::string shown(std::string_view text) {
        std::string shown(text.substr(0, 30));
        for (char& c : shown)
            if (static_cast<unsigned char>(c) < ' ') c = '?';
        return shown;
    }

    const std::string& bytes_;
    std::string file_;
    std::size_t at_ = 0;
    bool binary_ = false;
    ByteOrder order_ = ByteOrder::little;
};

}  // namespace lamina::io
