// Fast writing of text formats: lines are formatted in parallel and written in order.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>

#include <lamina/point.hpp>

#include "core/parallel.hpp"
#include "core/uninitialized.hpp"

namespace lamina::io {

/// One line in the making: numbers and words with one blank between them. The buffer must be long enough for them.
class LineText {
public:
    explicit LineText(char* at) : at_(at) {}

    LineText& operator<<(std::size_t value) {
        at_ = std::to_chars(at_, at_ + 20, value).ptr;
        *at_++ = ' ';
        return *this;
    }
    LineText& operator<<(long value) {
        at_ = std::to_chars(at_, at_ + 20, value).ptr;
        *at_++ = ' ';
        return *this;
    }
    /// Adds a number with 17 significant digits, which every double is read back from exactly.
    LineText& operator<<(double value) {
        at_ = std::to_chars(at_, at_ + 30, value, std::chars_format::scientific, 16).ptr;
        *at_++ = ' ';
        return *this;
    }
    LineText& hexadecimal(std::size_t value) {
        at_ = std::to_chars(at_, at_ + 20, value, 16).ptr;
        *at_++ = ' ';
        return *this;
    }
    /// Adds a number with 17 significant digits, without an exponent where that is shorter.
    LineText& general(double value) {
        at_ = std::to_chars(at_, at_ + 30, value, std::chars_format::general, 17).ptr;
        *at_++ = ' ';
        return *this;
    }
    LineText& operator<<(Point p) { return *this << p.x << p.y; }
    LineText& operator<<(std::string_view word) {
        at_ += word.copy(at_, word.size());
        *at_++ = ' ';
        return *this;
    }
    /// Adds a word without a blank behind it.
    LineText& tight(std::string_view word) {
        at_ += word.copy(at_, word.size());
        return *this;
    }
    /// Takes back the last blank.
    LineText& take_back() {
        --at_;
        return *this;
    }
    /// Replaces the last blank by the end of the line, and returns the position behind it.
    char* end_line() {
        at_[-1] = '\n';
        return at_;
    }

private:
    char* at_;
};

/// Room for eight indices, or for an index and three coordinates.
inline constexpr std::size_t default_line_bytes = 128;

/// Returns the lines [begin, end): line i is what put_line(LineText&, i) adds, at most `max_line_bytes` bytes with its
/// end. Runs on the calling thread.
template <class F>
std::string format_lines(std::size_t begin, std::size_t end, F&& put_line,
                         std::size_t max_line_bytes = default_line_bytes) {
    // Lines are far shorter than their longest possible length, so only a small buffer has room for that.
    constexpr std::size_t lines_at_once = 64;
    core::UninitializedArray<char> buffer(lines_at_once * max_line_bytes);
    std::string text;
    text.reserve((end - begin) * max_line_bytes / 4);
    while (begin < end) {
        char* at = buffer.data();
        for (const std::size_t stop = std::min(end, begin + lines_at_once); begin < stop; ++begin) {
            LineText line(at);
            put_line(line, begin);
            at = line.end_line();
        }
        text.append(buffer.data(), at);
    }
    return text;
}

/// Writes n lines. Line i is what put_line(LineText&, i) adds, at most `max_line_bytes` bytes with its end. Memory
/// holds a bounded number of lines at a time.
template <class F>
void write_lines(std::ostream& out, std::size_t n, F&& put_line, std::size_t max_line_bytes = default_line_bytes) {
    constexpr std::size_t grain = 1 << 13;
    const std::size_t batch = grain * 4 * thread_count();
    for (std::size_t start = 0; start < n; start += batch) {
        const auto format_block = [&](std::size_t begin, std::size_t end) {
            return format_lines(start + begin, start + end, put_line, max_line_bytes);
        };
        for (const std::string& text : core::parallel_blocks(std::min(batch, n - start), grain, format_block))
            out.write(text.data(), static_cast<std::streamsize>(text.size()));
    }
}

}  // namespace lamina::io
