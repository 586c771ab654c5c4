// The reader without the file: text -> elements.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina {

/// What read_airfoil() makes of a file of this content; `file` is for messages.
std::vector<Element> parse_airfoil(std::string_view text, const std::string& file);

}  // namespace lamina
