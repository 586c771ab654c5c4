// The stage as a whole: inputs -> named, checked elements.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <lamina/files.hpp>
#include <lamina/geometry.hpp>
#include <set>

#include "geometry/coordinate_text.hpp"
#include "geometry/outline_repair.hpp"
#include "geometry/outlines.hpp"
#include "geometry/parse_airfoil.hpp"

namespace lamina::geometry {

namespace {

constexpr std::size_t max_name_length = 32;              // CGNS
constexpr std::string_view far_field_name = "farfield";  // the marker every mesh has besides those of the elements
constexpr std::string_view naca_prefix = "naca:";

/// naca:DIGITS[:POINTS][:blunt|:sharp]
Element read_naca(const std::string& input, std::size_t default_points) {
    std::vector<std::string> parts;
    for (std::size_t start = naca_prefix.size(); start <= input.size();) {
        const std::size_t end = std::min(input.find(':', start), input.size());
        parts.push_back(input.substr(start, end - start));
        start = end + 1;
    }
    std::size_t points = default_points;
    TrailingEdge trailing_edge = TrailingEdge::sharp;
    const auto is_style = [](const std::string& s) { return s == "blunt" || s == "sharp"; };
    if (parts.size() > 1 && is_style(parts.back())) {
        if (parts.back() == "blunt") trailing_edge = TrailingEdge::blunt;
        parts.pop_back();
    }
    if (parts.size() == 2) {
        const std::string& s = parts[1];
        const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), points);
        if (error != std::errc() || end != s.data() + s.size())
            throw UsageError(fmt::format("{}: '{}' is not a number of points", input, s));
    } else if (parts.size() != 1) {
        throw UsageError(fmt::format("{}: expected naca:DIGITS[:POINTS][:blunt]", input));
    }
    Element element = naca_airfoil(parts[0], points, trailing_edge);
    element.file = input;
    return element;
}

std::string sanitised(const std::string& name) {
    std::string clean;
    for (char c : name) {
        const bool keep = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                          c == '-' || c == '.' || c == '+';
        clean += keep ? c : '_';
    }
    return clean.empty() ? "element" : clean.substr(0, max_name_length);
}

std::string base_name(const Element& element) {
    if (!element.file.starts_with(naca_prefix)) return sanitised(std::filesystem::path(element.file).stem().string());
    return "naca" + sanitised(element.file.substr(naca_prefix.size(),
                                                  element.file.find(':', naca_prefix.size()) - naca_prefix.size()));
}

/// File stems; where several elements share one, all of them get a number: main_1, main_2.
void name_by_file(std::vector<Element>& elements) {
    std::vector<std::string> stems;
    for (const Element& e : elements) stems.push_back(base_name(e));
    std::set<std::string> used{std::string(far_field_name)};
    for (const std::string& stem : stems)
        if (std::count(stems.begin(), stems.end(), stem) == 1) used.insert(stem);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        elements[i].name = stems[i];
        if (std::count(stems.begin(), stems.end(), stems[i]) == 1 && stems[i] != far_field_name) continue;
        for (std::size_t number = 1;; ++number) {
            const std::string suffix = fmt::format("_{}", number);
            elements[i].name = stems[i].substr(0, max_name_length - suffix.size()) + suffix;
            if (used.insert(elements[i].name).second) break;
        }
    }
}

void name_as_asked(std::vector<Element>& elements, const std::vector<std::string>& names) {
    if (names.size() != elements.size())
        throw UsageError(fmt::format("{} name{} given for {} element{}", names.size(), names.size() == 1 ? "" : "s",
                                     elements.size(), elements.size() == 1 ? "" : "s"));
    std::set<std::string> used;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i].empty() || names[i].size() > max_name_length || sanitised(names[i]) != names[i])
            throw UsageError(
                fmt::format("the name '{}' must have 1 to {} letters, digits or _ - . +", names[i], max_name_length));
        if (names[i] == far_field_name)
            throw UsageError(fmt::format("the name '{}' is that of the outer boundary", names[i]));
        if (!used.insert(names[i]).second) throw UsageError(fmt::format("the name '{}' is given twice", names[i]));
        elements[i].name = names[i];
    }
}

void name_elements(std::vector<Element>& elements, const GeometryOptions& options) {
    if (!options.names.empty()) {
        name_as_asked(elements, options.names);
    } else if (elements.size() == 1) {
        elements[0].name = "airfoil";
    } else {
        name_by_file(elements);
    }
}

}  // namespace

std::vector<Element> parse_airfoil(std::string_view text, const std::string& file) {
    std::vector<Element> elements;
    for (const RawOutline& outline : assemble_outlines(read_rows(text, file), file))
        elements.push_back(repair_outline(outline, file));
    return elements;
}

Geometry finish(std::vector<Element> elements, const GeometryOptions& options) {
    Geometry geometry{std::move(elements)};
    name_elements(geometry.elements, options);
    check_simple(geometry);
    return geometry;
}

}  // namespace lamina::geometry

namespace lamina {

using namespace geometry;

std::vector<Element> read_airfoil(const std::filesystem::path& file) {
    return finish(parse_airfoil(read_file(file), file.string()), {}).elements;
}

Geometry read_geometry(std::span<const std::string> inputs, const GeometryOptions& options) {
    validate(options);
    if (inputs.empty()) throw UsageError("no input given");
    std::vector<Element> elements;
    for (const std::string& input : inputs) {
        if (input.starts_with(naca_prefix)) {
            elements.push_back(read_naca(input, options.naca_points));
        } else {
            for (Element& element : parse_airfoil(read_file(input), input)) elements.push_back(std::move(element));
        }
    }
    return finish(std::move(elements), options);
}

}  // namespace lamina
