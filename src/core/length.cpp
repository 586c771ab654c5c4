#include "core/length.hpp"

#include <lamina/error.hpp>

#include "core/text.hpp"

namespace lamina::core {

namespace {

/// What stands behind a number of units of the input.
constexpr char unit_suffix = 'u';

}  // namespace

Length parse_length(const std::string& text) {
    const bool in_input_units = text.ends_with(unit_suffix);
    try {
        const double value = parse_number(in_input_units ? text.substr(0, text.size() - 1) : text);
        return {value, in_input_units ? LengthUnit::input : LengthUnit::chord};
    } catch (const UsageError&) {
        throw UsageError("'" + text + "' is not a length, such as 0.003 (chords) or 0.003u (units of the input)");
    }
}

std::string length_text(Length length) {
    const std::string number = to_text(length.value);
    return length.unit == LengthUnit::input ? number + unit_suffix : number;
}

}  // namespace lamina::core
