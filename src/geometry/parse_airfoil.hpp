// The text of an airfoil file -> elements, repaired and oriented but neither named nor checked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <lamina/geometry.hpp>

#include "geometry/outlines.hpp"

namespace lamina::geometry {

/// Returns the outlines of an airfoil file, halves mirrored where the options ask for it. Throws InputError, which
/// names `file`.
std::vector<RawOutline> read_outlines(std::string_view text, const std::string& file, const GeometryOptions& options);

/// Returns the elements of an airfoil file. Throws InputError, which names `file`.
std::vector<Element> parse_airfoil(std::string_view text, const std::string& file, const GeometryOptions& options = {});

}  // namespace lamina::geometry
