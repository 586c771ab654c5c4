// Ranges of numbers: A:B[:STEP], as angles of attack of a polar and values of a sweep are written.
//
// Guarantees:
//  1. Values are the decimal numbers that are meant, where first and step have at most 9 decimals: those of 0:0.3:0.1
//     are 0, 0.1, 0.2 and 0.3 to the last bit.
// Limits:
//  1. A range has at most 10,000 values.
//  2. The last value may be above `last` by 1e-9 of a step, as rounding makes it.
// Example:
//     const std::vector<double> angles = values_of(parse_range("-4:18:2"));
//     assert(angles.size() == 12 && angles.front() == -4 && angles.back() == 18);
#pragma once

#include <string>
#include <vector>

#include <lamina/export.hpp>

namespace lamina {

/// The numbers first, first + step, first + 2 step, ... up to `last`.
struct ValueRange {
    double first = 0;  ///< the first number
    double last = 0;   ///< no number beyond this
    double step = 1;   ///< from each to the next, > 0
    /// Returns whether all three are equal.
    friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// Returns whether a text is meant as a range: whether it has a colon.
LAMINA_EXPORT bool is_range(const std::string& text);
/// Reads "A:B" or "A:B:STEP"; the step is 1 where none is given. Throws UsageError with the bare reason, as validate().
LAMINA_EXPORT ValueRange parse_range(const std::string& text);
/// Throws UsageError for numbers that are not finite, a step that is not above 0, first > last, and more than 10,000
/// values.
LAMINA_EXPORT void validate(const ValueRange& range);
/// Returns the text that parse_range() reads back.
LAMINA_EXPORT std::string range_text(const ValueRange& range);
/// Returns the numbers of a range, ascending. Precondition: validate().
LAMINA_EXPORT std::vector<double> values_of(const ValueRange& range);

}  // namespace lamina
