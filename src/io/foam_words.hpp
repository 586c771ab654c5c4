// The syntax of OpenFOAM's files in ASCII. Source: OpenFOAM user guide, "Basic input/output file format".
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "io/number_text.hpp"

namespace lamina::io {

/// The words of a file in OpenFOAM's syntax. A bracket or a semicolon is a word by itself; comments count as blanks.
class FoamWords {
public:
    explicit FoamWords(const std::filesystem::path& file) : file_(file.string()), bytes_(read_file(file)) {}

    /// Reads a word. Returns an empty text at the end.
    std::string_view next() {
        skip_blanks();
        const std::size_t first = at_;
        if (at_ < bytes_.size() && bytes_[at_] == '"') {
            at_ = std::min(bytes_.find('"', at_ + 1), bytes_.size() - 1) + 1;
        } else if (at_ < bytes_.size() && is_bracket(bytes_[at_])) {
            ++at_;
        } else {
            while (at_ < bytes_.size() && !is_blank(bytes_[at_]) && !is_bracket(bytes_[at_])) ++at_;
        }
        return std::string_view(bytes_).substr(first, at_ - first);
    }
    void expect(std::string_view expected) {
        if (const std::string_view word = next(); word != expected)
            fail(fmt::format("'{}' expected, found '{}'", expected, word.substr(0, 30)));
    }
    /// Reads a number; `meaning` names it in errors.
    template <class T>
    T number(const char* meaning) {
        const std::string_view word = next();
        const std::optional<T> value = parse_whole<T>(word);
        if (!value) fail(fmt::format("{} expected, found '{}'", meaning, word.substr(0, 30)));
        return *value;
    }
    /// Reads "N (" and returns N. Fails where the rest of the file is too short for N entries of `min_bytes` each, with
    /// what divides them, so that no damaged count asks for memory.
    std::size_t begin_list(const char* meaning, std::size_t min_bytes) {
        const auto n = number<std::size_t>(meaning);
        if (n > (bytes_.size() - at_) / min_bytes)
            fail(fmt::format("{}: {}, but the file is shorter than that", meaning, n));
        expect("(");
        return n;
    }
    void end_list() {
        expect(")");
        if (!next().empty()) fail("something follows the list");
    }
    /// Reads numbers behind "N (" in the machine's own bytes, as binary files have them, without the bracket that
    /// follows.
    std::vector<double> binary_numbers(std::size_t count) {
        if (count > (bytes_.size() - at_) / sizeof(double)) fail("the file ends within a list");
        std::vector<double> numbers(count);
        std::memcpy(numbers.data(), bytes_.data() + at_, count * sizeof(double));
        at_ += count * sizeof(double);
        return numbers;
    }
    /// Whether the header announces a binary file.
    bool is_binary() const { return binary_; }
    /// Reads "FoamFile { ... }" and returns the class of its contents. Fails unless it announces ASCII or, where the
    /// caller copes with lists in binary, those of numbers of 64 bits.
    std::string read_header(bool copes_with_binary = false) {
        std::string type;
        expect("FoamFile");
        expect("{");
        for (std::string_view key; (key = next()) != "}";) {
            const std::string_view value = next();
            if (key.empty() || value.empty()) fail("the header does not end");
            if (key == "format") binary_ = value == "binary";
            if (key == "format" && value != "ascii" && !(binary_ && copes_with_binary))
                fail("only ASCII can be read (foamFormatConvert makes it)");
            if (key == "arch" && (!value.starts_with("\"LSB") || value.find("scalar=32") != std::string_view::npos))
                odd_arch_ = true;
            if (key == "class") type = value;
            expect(";");
        }
        if (binary_ && odd_arch_) fail("only numbers of 64 bits, the least byte first, can be read in binary");
        return type;
    }
    /// Does the same, and fails where the contents are of another class.
    void read_header(std::string_view type) {
        if (const std::string found = read_header(); !found.empty() && found != type)
            fail(fmt::format("class {} expected", type));
    }
    /// Throws InputError with the file and the line.
    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError({file_, line_at(bytes_, at_), {}}, reason);
    }

private:
    static bool is_bracket(char c) { return c == '(' || c == ')' || c == '{' || c == '}' || c == ';'; }
    void skip_blanks() {
        while (at_ < bytes_.size()) {
            const std::string_view rest = std::string_view(bytes_).substr(at_);
            if (is_blank(rest.front()))
                ++at_;
            else if (rest.starts_with("//"))
                at_ = std::min(bytes_.find('\n', at_), bytes_.size());
            else if (rest.starts_with("/*"))
                at_ = std::min(bytes_.find("*/", at_ + 2), bytes_.size() - 2) + 2;
            else
                return;
        }
    }

    std::string file_, bytes_;
    std::size_t at_ = 0;
    bool binary_ = false, odd_arch_ = false;  ///< what the header says
};

}  // namespace lamina::io
