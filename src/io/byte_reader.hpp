// Reading of formats that hold the same numbers in ASCII or in binary: one reader serves both.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "io/binary_output.hpp"
#include "io/number_text.hpp"

namespace lamina::io {

/// The words and numbers of a file that is ASCII or, from some position on, binary.
class ByteReader {
public:
    /// The bytes must outlive this object.
    ByteReader(const std::string& bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

    /// From here on number() reads binary numbers.
    void set_binary(ByteOrder order) {
        binary_ = true;
        order_ = order;
    }
    bool binary() const { return binary_; }

    /// Reads a word, also from a binary file. Returns an empty text at the end.
    std::string_view word() {
        skip_blanks();
        const std::size_t first = at_;
        while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
        return std::string_view(bytes_).substr(first, at_ - first);
    }
    /// Reads the rest of the line, and returns it without blanks round it.
    std::string_view rest_of_line() {
        const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
        std::string_view rest = std::string_view(bytes_).substr(at_, end - at_);
        at_ = std::min(end + 1, bytes_.size());
        while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
        while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
        return rest;
    }
    /// Reads a number that is written in ASCII, also from a binary file; `meaning` names it in errors.
    template <class T>
    T ascii_number(const char* meaning) {
        const std::string_view text = word();
        const std::optional<T> value = parse_whole<T>(text);
        if (!value) fail(fmt::format("{} expected, found '{}'", meaning, printable(text)));
        return *value;
    }
    template <class T>
    T number(const char* meaning) {
        if (!binary_) return ascii_number<T>(meaning);
        if (bytes_.size() - at_ < sizeof(T)) fail(fmt::format("the file ends where {} is expected", meaning));
        at_ += sizeof(T);
        return load<T>(bytes_.data() + at_ - sizeof(T), order_);
    }
    /// Returns a count of things that follow in the file. Fails where the rest of the file is too short for that many
    /// of at least `bytes_each` bytes in a binary file, or two in an ASCII file, so that no damaged count asks for
    /// memory.
    std::size_t checked_count(std::size_t value, std::size_t bytes_each, const char* meaning) const {
        if (value > (bytes_.size() - at_) / (binary_ ? bytes_each : 2) + 1)
            fail(fmt::format("{}: {}, but the file is shorter than that", meaning, value));
        return value;
    }
    /// Reads a word. Fails unless it is `expected`.
    void expect(std::string_view expected) {
        if (const std::string_view found = word(); found != expected)
            fail(fmt::format("{} expected, found '{}'", expected, printable(found)));
    }
    /// Goes to the position behind the next `text`. Fails where there is none.
    void skip_behind(const std::string& text) {
        const std::size_t found = bytes_.find(text, at_);
        if (found == std::string::npos) fail(fmt::format("the file ends without {}", text));
        at_ = found + text.size();
    }
    bool at_end() {
        if (!binary_) skip_blanks();
        return at_ == bytes_.size();
    }
    /// Throws InputError with the file and, for ASCII files, the line.
    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError({file_, binary_ ? 0 : line_at(bytes_, at_), {}}, reason);
    }

private:
    void skip_blanks() {
        while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
    }
    /// Returns the beginning of a text with ? for control characters.
    static std::string printable(std::string_view text) {
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
