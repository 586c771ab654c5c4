// Reading of text formats that consist of lines of words and numbers. Errors name the line.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

namespace lamina::io {

/// The lines of a file, without comments and blank lines. Nothing depends on the locale.
class TextLines {
public:
    /// `comment` starts a comment that runs to the end of its line; `blanks` are the characters between numbers. The
    /// bytes must outlive this object.
    TextLines(std::string_view bytes, std::string file, char comment, std::string_view blanks = " \t\r")
        : rest_(bytes), blanks_(blanks), file_(std::move(file)), comment_(comment) {}

    /// Goes to the next line that holds something. Returns false at the end of the file.
    bool next() {
        while (!rest_.empty()) {
            const std::size_t end = rest_.find('\n');
            line_ = rest_.substr(0, end);
            rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
            ++number_;
            line_ = line_.substr(0, line_.find(comment_));
            if (!at_end()) return true;
        }
        return false;
    }
    /// Returns KEY where the line reads "KEY = value", and leaves the value; returns nothing for other lines.
    std::optional<std::string_view> key() {
        const std::size_t equals = line_.find('=');
        if (equals == std::string_view::npos) return std::nullopt;
        const std::string_view key = trimmed(line_.substr(0, equals));
        line_.remove_prefix(equals + 1);
        return key;
    }
    /// Returns the rest of the line.
    std::string_view text() const { return trimmed(line_); }
    bool at_end() {
        line_.remove_prefix(std::min(line_.find_first_not_of(blanks_), line_.size()));
        return line_.empty();
    }
    /// Reads a number; `meaning` names it in errors.
    template <class T>
    T number(const char* meaning) {
        if (at_end()) fail(fmt::format("{} expected", meaning));
        if (line_.front() == '+') line_.remove_prefix(1);
        T value{};
        const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
        const auto used = static_cast<std::size_t>(end - line_.data());
        if (error != std::errc{} || (used < line_.size() && blanks_.find(line_[used]) == std::string_view::npos))
            fail(fmt::format("{} expected, found '{}'", meaning,
                             line_.substr(0, std::min<std::size_t>(30, line_.find_first_of(blanks_)))));
        line_.remove_prefix(used);
        return value;
    }
    /// Throws InputError with the file and the line.
    [[noreturn]] void fail(const std::string& reason) const { throw InputError({file_, number_, {}}, reason); }
    std::size_t bytes_left() const { return rest_.size(); }
    std::size_t line() const { return number_; }

private:
    std::string_view trimmed(std::string_view s) const {
        const std::size_t first = s.find_first_not_of(blanks_);
        if (first == std::string_view::npos) return {};
        return s.substr(first, s.find_last_not_of(blanks_) - first + 1);
    }

    std::string_view rest_, line_, blanks_;
    std::string file_;
    std::size_t number_ = 0;
    char comment_;
};

}  // namespace lamina::io
