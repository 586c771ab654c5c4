// Fast writing of text formats: lines are put together in parallel blocks and sent in order.
#pragma once

#include <charconv>
#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>

#include <lamina/point.hpp>

#include "core/parallel.hpp"

namespace lamina::io {

/// One line in the making: numbers and words, one blank between them, behind each other in a buffer that is long
/// enough.
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
    /// 17 significant digits: every double comes back as it was.
    LineText& operator<<(double value) {
        at_ = std::to_chars(at_, at_ + 30, value, std::chars_format::scientific, 16).ptr;
        *at_++ = ' ';
        return *this;
    }
    /// The same, without an exponent where it is shorter so.
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
    /// A word without a blank behind it.
    LineText& tight(std::string_view word) {
        at_ += word.copy(at_, word.size());
        return *this;
    }
    /// Takes back the last blank.
    LineText& take_back() {
        --at_;
        return *this;
    }
    char* end_line() {
        at_[-1] = '\n';
        return at_;
    }

private:
    char* at_;
};

/// Enough for eight indices, or an index and three coordinates.
inline constexpr std::size_t longest_line = 128;

/// Line i is what put_line(LineText&, i) puts in, at most `longest` bytes with its end. Formatted in parallel, a
/// bounded number of blocks at a time.
template <class F>
void write_lines(std::ostream& out, std::size_t n, F&& put_line, std::size_t longest = longest_line) {
    constexpr std::size_t grain = 1 << 13;
    const std::size_t batch = grain * 4 * thread_count();
    for (std::size_t start = 0; start < n; start += batch) {
        const auto format_block = [&](std::size_t begin, std::size_t end) {
            std::string text((end - begin) * longest, '\0');
            char* p = text.data();
            for (std::size_t i = start + begin; i < start + end; ++i) {
                LineText line(p);
                put_line(line, i);
                p = line.end_line();
            }
            text.resize(static_cast<std::size_t>(p - text.data()));
            return text;
        };
        for (const std::string& text : core::parallel_blocks(std::min(batch, n - start), grain, format_block))
            out.write(text.data(), static_cast<std::streamsize>(text.size()));
    }
}

}  // namespace lamina::io
