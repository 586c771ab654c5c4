// Units of length as coordinate files write them, behind numbers or beside the names of columns.
#pragma once

#include <optional>
#include <string_view>

namespace lamina::geometry {

/// A unit of length.
struct LengthUnitName {
    std::string_view name;  ///< as messages write it: "mm"
    double metres;          ///< how long it is
};

/// Returns the unit that a text names, whatever its case: "mm", "in", "inch", "m". Empty for other texts.
std::optional<LengthUnitName> length_unit(std::string_view text);

/// Returns the unit of coordinates that a title names: "main (mm)", "all dimensions in inches", "units: mm", or by the
/// chord, "chord = 250 mm", where an outline of this length in x is as long as that but for one in a hundred. Empty for
/// other titles.
std::optional<LengthUnitName> unit_of_title(std::string_view title, double length);

}  // namespace lamina::geometry
