// Reads from the names in a header line what the columns below it hold. This is the one table of the names that lamina
// knows.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::geometry {

/// The quantity that a column holds.
enum class ColumnRole {
    unknown,
    x,
    y,
    z,
    upper_x,
    upper,  ///< ordinates of the upper surface
    lower_x,
    lower,           ///< ordinates of the lower surface
    thickness,       ///< from the lower to the upper surface
    half_thickness,  ///< from the camber line to either surface, as y_t of NACA sections
    camber,          ///< ordinates of the camber line
    counter,         ///< numbers of points or curves
};

/// Returns the roles of columns that a header names. Names are in lower case; units in brackets, "/c" and separators
/// within them count for nothing. Two columns of x and two of y are those of two surfaces.
std::vector<ColumnRole> column_roles(const std::vector<std::string>& names);

/// Returns the only column with this role, if there is one.
std::optional<std::size_t> column_with(const std::vector<ColumnRole>& roles, ColumnRole role);

/// Returns the names of the units that stand beside the names of columns, as in "x [mm]" and "x (%)", each once.
std::vector<std::string> units_of_names(const std::vector<std::string>& names);

/// Returns the name of the unit of length that a text is, perhaps in brackets: "mm" of "[mm]"; empty for other texts.
std::string unit_of_text(std::string_view text);

/// Returns whether all these names are units: a line of them below the names is no header of its own.
bool are_units(const std::vector<std::string>& names);

}  // namespace lamina::geometry
