// The fields of a solution that a user names: "p", "U:x", "mag(U)".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lamina::io {

/// The part of an array that a field takes.
enum class FieldPart {
    scalar,     ///< its only component
    component,  ///< one of several
    magnitude,  ///< the length of each vector
};

/// A field that is to be read.
struct FieldRequest {
    std::string name;   ///< as the user gives it
    std::string array;  ///< name of the array
    FieldPart part = FieldPart::scalar;
    std::size_t component = 0;  ///< for FieldPart::component
};

/// Reads the name of a field. Throws UsageError for empty names and unknown components.
FieldRequest parse_field(const std::string& name);

/// Returns the values that are asked for, one per tuple of `components` values. Throws UsageError where the array has
/// no such component, or several where one is needed, and where a value is not finite.
std::vector<double> part_of(const FieldRequest& field, std::span<const double> values, std::size_t components);

}  // namespace lamina::io
