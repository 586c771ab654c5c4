#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "geometry/characters.hpp"
#include "geometry/other_formats.hpp"

namespace lamina::geometry {

namespace {

/// Returns the line at the start of a text, trimmed, and removes it.
std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return trimmed(line.substr(0, line.find('\r')));
}

/// Returns whether a text is DXF: group codes and values in turn, of which the first but for comments is a section.
bool is_dxf(std::string_view text) {
    std::string_view code = take_line(text), value = take_line(text);
    while (code == "999" && !text.empty()) {
        code = take_line(text);
        value = take_line(text);
    }
    return code == "0" && value == "SECTION";
}

/// Returns whether a text is IGES: lines of 80 columns, the first of which belong to the start section.
bool is_iges(std::string_view text) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    constexpr std::size_t section_column = 72;
    return line.size() == 80 && line[section_column] == 'S' && line.ends_with('1');
}

struct Drawing {
    const char* name;
    const char* advice;
    bool (*is_it)(std::string_view);
};

constexpr const char* flatten = "turn the outline into a polyline and export its vertices";

constexpr std::array<Drawing, 4> drawings = {
    {{"a DXF drawing", flatten, is_dxf},
     {"an SVG drawing", "flatten the path and export its points",
      [](std::string_view text) { return text.substr(0, 4096).find("<svg") != std::string_view::npos; }},
     {"an IGES file", "divide the curves and export the points", is_iges},
     {"a STEP file", "divide the curves and export the points",
      [](std::string_view text) { return trimmed(text.substr(0, 64)).starts_with("ISO-10303-21"); }}}};

}  // namespace

void refuse_drawings(std::string_view text, const std::string& file) {
    for (const Drawing& drawing : drawings)
        if (drawing.is_it(text))
            throw InputError({file, 1, {}}, fmt::format("{}, of which lamina reads no curves: {}, one line 'x y' each",
                                                        drawing.name, drawing.advice));
}

}  // namespace lamina::geometry
