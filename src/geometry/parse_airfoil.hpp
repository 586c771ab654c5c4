// Makes elements of the text of an airfoil file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Returns the repaired elements of the text of a file, without names. `file` names it in messages. Throws InputError.
std::vector<Element> parse_airfoil(std::string_view text, const std::string& file);

}  // namespace lamina::geometry
