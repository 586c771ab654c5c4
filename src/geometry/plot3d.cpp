#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "geometry/other_formats.hpp"

namespace lamina::geometry {

namespace {

/// The numbers of a text.
struct Numbers {
    std::vector<double> values;
    std::vector<std::uint32_t> lines;  ///< of each number
};

bool is_separator(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ','; }

/// Returns all numbers of a text; none where it holds anything else.
Numbers numbers_of(std::string_view text) {
    Numbers numbers;
    std::uint32_t line = 1;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
        if (is_separator(*at)) {
            line += *at == '\n' ? 1 : 0;
            ++at;
            continue;
        }
        double value = 0;
        const auto [rest, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || !std::isfinite(value) || (rest != end && !is_separator(*rest))) return {};
        numbers.values.push_back(value);
        numbers.lines.push_back(line);
        at = rest;
    }
    return numbers;
}

/// Returns whether the numbers stand in lines of two or three behind the first line, as points do.
bool are_points(const Numbers& numbers) {
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < numbers.values.size(); ++i) {
        if (i == 0 || numbers.lines[i] != numbers.lines[i - 1]) counts.push_back(0);
        ++counts.back();
    }
    if (counts.size() < 3) return false;
    const std::size_t columns = counts[1];
    if (columns != 2 && columns != 3) return false;
    for (std::size_t i = 1; i < counts.size(); ++i)
        if (counts[i] != columns) return false;
    return true;
}

/// The points of each block, and where their coordinates begin among the numbers.
struct Layout {
    std::vector<std::size_t> points;
    std::size_t start = 0;
    std::size_t dimensions = 2;
};

/// Returns the layout whose dimensions stand from `start` on, `indices` of them for each of `blocks`, if the numbers
/// fit it and all blocks are curves.
std::optional<Layout> layout_of(const std::vector<double>& values, std::size_t start, std::size_t blocks,
                                std::size_t indices) {
    if (blocks > values.size() / indices || start + blocks * indices > values.size()) return std::nullopt;
    const std::size_t data = start + blocks * indices, available = values.size() - data;
    Layout layout{{}, data, indices};
    std::size_t total = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        std::size_t points = 1, longer_than_one = 0;
        for (std::size_t k = 0; k < indices; ++k) {
            const double n = values[start + b * indices + k];
            if (n < 1 || n != std::floor(n) || n > static_cast<double>(available)) return std::nullopt;
            longer_than_one += n > 1 ? 1u : 0u;
            points = n > 1 ? static_cast<std::size_t>(n) : points;
        }
        if (longer_than_one != 1) return std::nullopt;
        layout.points.push_back(points);
        total += points;
    }
    return total * indices == available ? std::optional(layout) : std::nullopt;
}

std::optional<Layout> find_layout(const std::vector<double>& values) {
    for (const std::size_t indices : {std::size_t{3}, std::size_t{2}}) {
        if (auto single = layout_of(values, 0, 1, indices)) return single;
        const double blocks = values[0];
        if (blocks >= 1 && blocks == std::floor(blocks) && blocks < static_cast<double>(values.size()))
            if (auto several = layout_of(values, 1, static_cast<std::size_t>(blocks), indices)) return several;
    }
    return std::nullopt;
}

}  // namespace

std::optional<CoordinateDocument> read_plot3d(std::string_view text) {
    constexpr std::size_t fewest = 8;  // three points in a plane behind two dimensions
    const Numbers numbers = numbers_of(text);
    if (numbers.values.size() < fewest || are_points(numbers)) return std::nullopt;
    const std::optional<Layout> layout = find_layout(numbers.values);
    if (!layout) return std::nullopt;
    CoordinateDocument document;
    CoordinateSection& section = document.sections[0];
    std::size_t start = layout->start;
    for (const std::size_t points : layout->points) {
        section.blocks.push_back({static_cast<std::uint32_t>(section.points.size())});
        for (std::size_t i = start; i < start + points; ++i) {
            RowPoint& p = section.points.emplace_back();
            p.at = {numbers.values[i], numbers.values[i + points]};
            p.line = numbers.lines[i];
            p.columns = static_cast<std::uint16_t>(layout->dimensions);
            if (p.columns == 3) p.further = document.numbers.add({&numbers.values[i + 2 * points], 1});
        }
        start += points * layout->dimensions;
    }
    document.notes.push_back(
        fmt::format("PLOT3D: {} curve{}", layout->points.size(), layout->points.size() == 1 ? "" : "s"));
    return document;
}

}  // namespace lamina::geometry
