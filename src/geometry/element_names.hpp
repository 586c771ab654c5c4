// Names of elements, which become the names of their markers.
#pragma once

#include <string_view>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// The prefix of inputs that are generated NACA sections.
inline constexpr std::string_view naca_prefix = "naca:";

/// Names elements as the options say. Without names a single element is called "airfoil" and several take the stems of
/// their files. Names that no marker may have are changed, with a warning. Throws UsageError for a wrong number of
/// names and for repeated names.
void name_elements(std::vector<Element>& elements, const GeometryOptions& options);

/// The name that stands for all elements in options.
inline constexpr const char* every_element = "all";

/// Returns whether the name in an option stands for an element: its name, also as it was given, or "all".
bool stands_for(const std::string& name, const Element& element);

/// Throws OptionError, of the option with this key, for a name that stands for no element, and for "all" where one of
/// several has that name.
void require_known_element(const Geometry& geometry, const std::string& name, const std::string& key);

}  // namespace lamina::geometry
