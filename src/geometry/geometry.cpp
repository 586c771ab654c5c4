#include <lamina/geometry.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "core/option_builders.hpp"
#include "geometry/sheets.hpp"

namespace lamina {

namespace {

/// Includes the points of an element, but for the second sides of sheets, since the gap before them is no part of it.
void include_element(const Element& element, Box& box) {
    const std::size_t n = element.points.size();
    std::vector<char> is_behind(n);
    for (const geometry::SheetRange& range : geometry::sheet_ranges(element))
        for (std::size_t i = range.tip + 1; i <= range.last; ++i) is_behind[i % n] = i % n != range.first % n ? 1 : 0;
    for (std::size_t i = 0; i < n; ++i)
        if (is_behind[i] == 0) box.include(element.points[i]);
}

/// Returns where the elements lie without rotations and flaps.
std::vector<ElementBox> boxes_of_elements(const Geometry& geometry) {
    if (!geometry.unturned_elements.empty()) return geometry.unturned_elements;
    std::vector<ElementBox> boxes;
    for (const Element& element : geometry.elements) {
        boxes.push_back({element.name, element.given_name, {}});
        include_element(element, boxes.back().box);
    }
    return boxes;
}

Box box_of_element(const Geometry& geometry, const std::string& name) {
    std::vector<std::string> known;
    for (const ElementBox& element : boxes_of_elements(geometry)) {
        if (element.name == name || element.given_name == name) return element.box;
        known.push_back(element.name);
    }
    throw OptionError("chord", "element " + unknown_choice(name, known));
}

}  // namespace

Box bounding_box(const Geometry& geometry) {
    Box box;
    for (const Element& element : geometry.elements)
        for (Point p : element.points) box.include(p);
    return box;
}

Box reference_box(const Geometry& geometry) {
    if (geometry.unturned_box) return *geometry.unturned_box;
    Box box;
    for (const Element& element : geometry.elements) include_element(element, box);
    return box;
}

ReferenceConditions reference_conditions(const FlowConditions& conditions, const Geometry& geometry) {
    if (conditions.chord || conditions.chord_element.empty())
        return reference_conditions(conditions, reference_box(geometry));
    FlowConditions by_extent = conditions;
    by_extent.chord_element.clear();
    return reference_conditions(by_extent, box_of_element(geometry, conditions.chord_element));
}

}  // namespace lamina
