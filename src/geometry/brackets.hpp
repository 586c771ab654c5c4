// Numbers in brackets, as programs print lists of points.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lamina::geometry {

/// Returns the rows of a line whose numbers stand in brackets, without these: one for "(1.0, 0.0)", "[1.0, 0.0],",
/// "(1.0) (0.0)" and "points = [[1.0, 0.0],", two for "[[1.0, 0.0], [0.9, 0.01]]" and "[1.0 0.0; 0.9 0.01]". Brackets
/// may open or close on other lines. Returns nothing for other lines, among them numbers with a remark in brackets
/// behind them, and words with numbers in brackets behind them.
std::vector<std::string> rows_in_brackets(std::string_view line);

/// Returns whether a line holds nothing but brackets and separators, as those that end a list do.
bool has_brackets_alone(std::string_view line);

}  // namespace lamina::geometry
