#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/error.hpp>

#include "core/text.hpp"
#include "geometry/characters.hpp"
#include "geometry/drawings/drawing.hpp"
#include "geometry/drawings/outlines_of_drawing.hpp"
#include "geometry/other_formats.hpp"

namespace lamina::geometry {

namespace {

/// Returns whether a text is DXF: group codes and values in turn, of which the first but for comments is a section.
bool is_dxf(std::string_view text) {
    std::string_view code = take_line(text), value = take_line(text);
    while (code == "999" && !text.empty()) {
        code = take_line(text);
        value = take_line(text);
    }
    return (code == "0" && value == "SECTION") || code.starts_with("AutoCAD Binary DXF");
}

/// Returns whether a text is IGES: lines of 80 columns, the first of which belong to the start section.
bool is_iges(std::string_view text) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    constexpr std::size_t section_column = 72;
    return line.size() == 80 && line[section_column] == 'S' && line.ends_with('1');
}

/// Returns whether an object follows somewhere: an opening brace and a name.
bool has_object(std::string_view text) {
    for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
        const auto next = std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(at) + 1, text.end(), is_blank);
        if (next != text.end() && (*next == '"' || *next == '\'' || is_letter(*next))) return true;
    }
    return false;
}

/// A list of JSON that holds no other list.
struct InnerList {
    std::size_t numbers = 0;
    bool has_lines = false;  ///< whether it stands in several lines
};

/// Returns the first lists of a text that hold no other list, at most three; nothing where a list is none of JSON.
std::vector<InnerList> first_inner_lists(std::string_view text) {
    std::vector<InnerList> lists;
    while (lists.size() < 3) {
        const std::size_t close = text.find(']');
        if (close == std::string_view::npos) break;
        const std::size_t open = text.rfind('[', close);
        if (open != std::string_view::npos) {
            const std::string_view list = text.substr(open + 1, close - open - 1);
            InnerList& inner = lists.emplace_back();
            std::size_t commas = 0;
            bool in_number = false;
            for (const char c : list) {
                const bool divides = is_blank(c) || c == ',';
                inner.numbers += !divides && !in_number ? 1 : 0;
                commas += c == ',' ? 1 : 0;
                inner.has_lines |= c == '\n' || c == '\r';
                in_number = !divides;
            }
            if (inner.numbers != commas + 1) return {};  // MATLAB's rows, for example
        }
        text.remove_prefix(close + 1);
    }
    return lists;
}

/// Returns whether a text may be JSON.
bool starts_json(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const auto first = std::find_if_not(text.begin(), text.end(), is_blank);
    return first != text.end() && (*first == '[' || *first == '{');
}

/// Returns whether a text is JSON that lists all x, then all y. Points have two or three numbers; a list of pairs
/// stands in several lines.
bool is_json_of_axes(std::string_view text) {
    if (!starts_json(text)) return false;
    const std::vector<InnerList> lists = first_inner_lists(text);
    if (lists.empty() || lists[0].has_lines || lists[0].numbers < 3) return false;
    return lists.size() < 3 || (lists[0].numbers > 3 && has_object(text));
}

/// Returns whether a text that cannot be read is JSON that lists no points, or each number of them on a line of its
/// own.
bool is_json_without_points(std::string_view text) {
    if (!starts_json(text)) return false;
    const std::vector<InnerList> lists = first_inner_lists(text);
    const bool lists_points = !lists.empty() && !lists[0].has_lines && (lists[0].numbers == 2 || lists[0].numbers == 3);
    return has_object(text) ? !lists_points : !lists.empty() && lists[0].has_lines;
}

struct Format {
    const char* name;
    const char* advice;
    std::array<const char*, 2> extensions;  ///< in whatever case; the second may be null
    bool (*is_it)(std::string_view);
    const char* short_name;                                 ///< as Element::format
    Drawing (*read)(std::string_view, const std::string&);  ///< null where it is not read
};

constexpr std::array<Format, 5> formats = {
    {{"a DXF drawing",
      "save it as ASCII with lines, arcs, polylines and splines (explode the rest), or export points",
      {".dxf"},
      is_dxf,
      "dxf",
      read_dxf},
     {"an SVG drawing",
      "turn objects to paths and unlink clones, or export points",
      {".svg"},
      [](std::string_view text) { return text.substr(0, 4096).find("<svg") != std::string_view::npos; },
      "svg",
      read_svg},
     {"an IGES file",
      "export the section's curves as B-splines (126), lines and arcs, or export points",
      {".igs", ".iges"},
      is_iges,
      "iges",
      read_iges},
     {"a STEP file",
      "export the section's edges as B-splines, lines and circles, or export points",
      {".stp", ".step"},
      [](std::string_view text) { return trimmed(text.substr(0, 64)).starts_with("ISO-10303-21"); },
      "step",
      read_step},
     {"JSON, of which lamina reads lists of points alone",
      "print the points, in Python by 'for p in zip(d[\"x\"], d[\"y\"]): print(*p)'",
      {".json", ".geojson"},
      is_json_of_axes,
      "json",
      nullptr}}};

[[noreturn]] void refuse(const Format& format, const std::string& reason, const std::string& file) {
    throw InputError({file, 1, {}}, fmt::format("{}{}: {}, one line 'x y' each", format.name, reason, format.advice));
}

/// Returns "2 TEXT, 1 DIMENSION".
std::string list_of(const std::map<std::string, std::size_t>& left_out) {
    std::vector<std::string> parts;
    parts.reserve(left_out.size());
    for (const auto& [kind, count] : left_out) parts.push_back(fmt::format("{} {}", count, kind));
    return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::optional<std::vector<RawOutline>> read_drawing(std::string_view text, const std::string& file, bool keep_open) {
    const auto format = std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.is_it(text); });
    if (format == formats.end()) return std::nullopt;
    if (format->read == nullptr) refuse(*format, "", file);
    if (text.starts_with("AutoCAD Binary")) refuse(*format, " in binary form", file);
    const Drawing drawing = format->read(text, file);
    const std::string left_out = list_of(drawing.left_out);
    if (drawing.curves.empty())
        refuse(*format, " without curves that lamina reads" + (left_out.empty() ? "" : " (" + left_out + ")"), file);
    std::vector<std::string> notes;
    if (!left_out.empty()) notes.push_back("left out of the drawing: " + left_out);
    std::vector<RawOutline> outlines = outlines_of_drawing(drawing, file, keep_open, notes);
    for (RawOutline& outline : outlines) {
        outline.format = format->short_name;
        outline.unit = drawing.unit;
    }
    outlines[0].notes.insert(outlines[0].notes.begin(), notes.begin(), notes.end());
    return outlines;
}

bool is_drawing_format(std::string_view format) {
    return std::any_of(formats.begin(), formats.end(),
                       [&](const Format& f) { return f.read != nullptr && f.short_name == format; });
}

void refuse_unread_drawings(std::string_view text, const std::string& file) {
    if (is_json_without_points(text)) refuse(formats.back(), "", file);
    const std::string name = core::lower_case(file);
    const auto is_extension = [&](const char* extension) { return extension != nullptr && name.ends_with(extension); };
    for (const Format& format : formats)
        if (std::any_of(format.extensions.begin(), format.extensions.end(), is_extension))
            refuse(format, format.read != nullptr ? " by its name, but not by what it holds" : "", file);
}

}  // namespace lamina::geometry
