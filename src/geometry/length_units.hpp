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

}  // namespace lamina::geometry
