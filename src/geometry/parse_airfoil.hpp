// Makes elements of the text of an airfoil file, and a checked geometry of elements.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Returns the repaired elements of the text of a file, without names. `file` names it in messages. Throws InputError.
std::vector<Element> parse_airfoil(std::string_view text, const std::string& file);

/// Names and transforms elements as the options say and checks that their outlines are simple and lie side by side.
/// Throws UsageError and InputError as read_geometry() does.
Geometry make_geometry(std::vector<Element> elements, const GeometryOptions& options);

}  // namespace lamina::geometry
