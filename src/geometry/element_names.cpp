#include "geometry/element_names.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/marker_names.hpp>

#include "core/marker_names.hpp"
#include "core/option_builders.hpp"

namespace lamina::geometry {

namespace {

bool is_named(const Element& e, const std::string& name) { return e.name == name || e.given_name == name; }

/// Returns the stem of the element's file, "naca" and its digits, or the name that standard input has.
std::string base_name(const Element& element) {
    if (element.file == input_name("-")) return "standard_input";
    if (!element.file.starts_with(naca_prefix)) return std::filesystem::path(element.file).stem().string();
    const std::size_t begin = naca_prefix.size(), end = element.file.find(':', begin);
    return "naca" + element.file.substr(begin, end - begin);
}

/// Returns the base names of elements. Where several elements share one, all of them get a number: main_1, main_2.
std::vector<std::string> names_by_file(const std::vector<Element>& elements) {
    std::vector<std::string> stems;
    stems.reserve(elements.size());
    for (const Element& e : elements) stems.push_back(base_name(e));
    std::map<std::string, std::size_t> count, tried;  // elements of a stem, and numbers that were tried for them
    for (const std::string& stem : stems) ++count[stem];
    const auto is_unique = [&](const std::string& stem) { return count[stem] == 1; };
    std::set<std::string> used;
    for (const std::string& stem : stems)
        if (is_unique(stem)) used.insert(stem);
    std::vector<std::string> names = stems;
    for (std::size_t i = 0; i < stems.size(); ++i) {
        if (is_unique(stems[i])) continue;
        for (;;) {
            const std::string suffix = fmt::format("_{}", ++tried[stems[i]]);
            names[i] = stems[i].substr(0, core::max_marker_name - suffix.size()) + suffix;
            if (used.insert(names[i]).second) break;
        }
    }
    return names;
}

/// Returns the names that the elements are to have, which differ from each other.
std::vector<std::string> wanted_names(const std::vector<Element>& elements, const std::vector<std::string>& given) {
    if (given.empty()) return elements.size() == 1 ? std::vector<std::string>{"airfoil"} : names_by_file(elements);
    if (given.size() != elements.size())
        throw UsageError(fmt::format("{} name{} given for {} element{}", given.size(), given.size() == 1 ? "" : "s",
                                     elements.size(), elements.size() == 1 ? "" : "s"));
    std::set<std::string> used;
    for (const std::string& name : given) {
        if (name.empty()) throw UsageError("names: a name is empty");
        if (!used.insert(name).second) throw UsageError(fmt::format("the name '{}' is given twice", name));
    }
    return given;
}

}  // namespace

void name_elements(std::vector<Element>& elements, const GeometryOptions& options) {
    std::vector<core::NamedMarker> markers;
    for (std::string& name : wanted_names(elements, options.names))
        markers.push_back({std::move(name), MarkerKind::wall});
    markers.push_back({std::string(core::far_field_name), MarkerKind::far_field});
    std::vector<std::string> names = core::legal_marker_names(markers);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        Element& element = elements[i];
        element.given_name = markers[i].name;
        element.name = std::move(names[i]);
        if (element.name != element.given_name)
            element.warnings.push_back(core::renamed_marker_warning(markers[i], element.name));
    }
}

bool stands_for(const std::string& name, const Element& element) {
    return name == every_element || is_named(element, name);
}

void require_known_element(const Geometry& geometry, const std::string& name, const std::string& key) {
    std::vector<std::string> names{std::string(every_element)};
    bool is_known = name == every_element;
    for (const Element& e : geometry.elements) {
        names.push_back(e.name);
        is_known = is_known || is_named(e, name);
    }
    if (!is_known) throw OptionError(key, "element " + unknown_choice(name, names));
    if (name == every_element && names.size() > 2 && std::count(names.begin(), names.end(), name) > 1)
        throw OptionError(key, fmt::format("'{}' means every element, and one has this name: give --names", name));
}

}  // namespace lamina::geometry
