#include "geometry/element_names.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "geometry/characters.hpp"

namespace lamina::geometry {

namespace {

constexpr std::size_t max_name_length = 32;              // the limit of CGNS
constexpr std::string_view far_field_name = "farfield";  // a marker that every mesh has beside those of its elements

/// Returns a name that may be a marker: characters that are not allowed become underscores, and long names are cut.
std::string sanitized(const std::string& name) {
    std::string clean;
    for (char c : name) {
        const bool allowed = is_letter(c) || is_digit(c) || c == '_' || c == '-' || c == '.' || c == '+';
        clean += allowed ? c : '_';
    }
    return clean.empty() ? "element" : clean.substr(0, max_name_length);
}

/// Returns the stem of the element's file, or "naca" and its digits.
std::string base_name(const Element& element) {
    if (!element.file.starts_with(naca_prefix)) return sanitized(std::filesystem::path(element.file).stem().string());
    const std::size_t begin = naca_prefix.size(), end = element.file.find(':', begin);
    return "naca" + sanitized(element.file.substr(begin, end - begin));
}

/// Names elements by their base names. Where several elements share one, all of them get a number: main_1, main_2.
void name_by_file(std::vector<Element>& elements) {
    std::vector<std::string> stems;
    stems.reserve(elements.size());
    for (const Element& e : elements) stems.push_back(base_name(e));
    const auto is_unique = [&](const std::string& stem) { return std::count(stems.begin(), stems.end(), stem) == 1; };
    std::set<std::string> used{std::string(far_field_name)};
    for (const std::string& stem : stems)
        if (is_unique(stem)) used.insert(stem);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        elements[i].name = stems[i];
        if (is_unique(stems[i]) && stems[i] != far_field_name) continue;
        for (std::size_t number = 1;; ++number) {
            const std::string suffix = fmt::format("_{}", number);
            elements[i].name = stems[i].substr(0, max_name_length - suffix.size()) + suffix;
            if (used.insert(elements[i].name).second) break;
        }
    }
}

void name_as_requested(std::vector<Element>& elements, const std::vector<std::string>& names) {
    if (names.size() != elements.size())
        throw UsageError(fmt::format("{} name{} given for {} element{}", names.size(), names.size() == 1 ? "" : "s",
                                     elements.size(), elements.size() == 1 ? "" : "s"));
    std::set<std::string> used;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i].empty() || sanitized(names[i]) != names[i])
            throw UsageError(
                fmt::format("the name '{}' must have 1 to {} letters, digits or _ - . +", names[i], max_name_length));
        if (names[i] == far_field_name)
            throw UsageError(fmt::format("the name '{}' is that of the outer boundary", names[i]));
        if (!used.insert(names[i]).second) throw UsageError(fmt::format("the name '{}' is given twice", names[i]));
        elements[i].name = names[i];
    }
}

}  // namespace

void name_elements(std::vector<Element>& elements, const GeometryOptions& options) {
    if (!options.names.empty()) {
        name_as_requested(elements, options.names);
    } else if (elements.size() == 1) {
        elements[0].name = "airfoil";
    } else {
        name_by_file(elements);
    }
}

}  // namespace lamina::geometry
