// The reader without the file: text -> elements.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Returns the repaired elements of a file of this content, without names. `file` is the name for messages.
std::vector<Element> parse_airfoil(std::string_view text, const std::string& file);

/// Names the elements and checks that their outlines are simple and lie side by side. Throws as read_geometry() does.
Geometry finish(std::vector<Element> elements, const GeometryOptions& options);

}  // namespace lamina::geometry
