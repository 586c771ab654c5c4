// Names of elements, which become the names of their markers.
#pragma once

#include <string_view>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// The prefix of inputs that are generated NACA sections.
inline constexpr std::string_view naca_prefix = "naca:";

/// Names elements as the options say. Without names a single element is called "airfoil" and several take the stems of
/// their files. Names that no marker may have are changed, with a warning. Throws UsageError for a wrong number of names
/// and for repeated names.
void name_elements(std::vector<Element>& elements, const GeometryOptions& options);

}  // namespace lamina::geometry
