// Sections as the package hands them over.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nanobind/nanobind.h>

#include <lamina/geometry.hpp>

namespace lamina::python {

/// A path or the name of a section, or points with the word that stands for their source in messages.
using Section = std::variant<std::string, std::pair<std::string, std::vector<Point>>>;

/// Returns the sections of a list of strings and of pairs (source, points). Precondition: the calling thread holds the
/// lock of the interpreter.
std::vector<Section> sections_of(const nanobind::list& list);

/// Reads and checks the sections, as read_geometry() does.
Geometry geometry_of(const std::vector<Section>& sections, const GeometryOptions& options);

}  // namespace lamina::python
