// One line of an airfoil file -> fields: numbers and words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::geometry {

enum class FieldKind {
    number,
    not_finite,   ///< "nan", "inf"
    too_extreme,  ///< a number that over- or underflows
    number_like,  ///< starts like a number, but is none
    word,
};

/// A number or a word of a line.
struct Field {
    std::string text;
    FieldKind kind = FieldKind::word;
    double value = 0;         ///< of a number
    std::string_view unit{};  ///< the unit of length behind a number, such as "mm"; empty: none
};

/// The fields of one line.
struct FieldList {
    std::vector<Field> fields;
    bool has_separators = false;        ///< fields are separated by commas or semicolons
    bool has_comma_separators = false;  ///< fields are separated by commas
    bool has_decimal_commas = false;    ///< commas were read as decimal points
};

/// How many fields of a line are looked at. No row of a table has as many; a file without line breaks would have
/// millions.
inline constexpr std::size_t max_fields = 1000;

/// Splits a line into fields, of which there are at most `max_fields`. White space separates fields; so does one comma
/// or semicolon with white space round it. Two separators in a row enclose an empty field. Quotes round a field, or
/// round the whole line, are removed. Where all fields fit, commas are decimal signs instead. Numbers are decimal,
/// correctly rounded and independent of the locale; Fortran's D exponents and a leading + are understood. A unit of
/// length may stand behind each number.
FieldList read_fields(std::string_view line);

/// Splits a line into names of columns, in lower case and without quotes: at semicolons, commas or tabs where there are
/// any, so that names may hold spaces, else at white space. A unit in brackets belongs to the name before it. Tecplot's
/// "VARIABLES =" before the names is left out.
std::vector<std::string> read_names(std::string_view line);

}  // namespace lamina::geometry
