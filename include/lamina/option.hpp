// Options as data. Each options struct of lamina has a table of its options: names, units, ranges and help stand there
// once. The command line, case files, the guide and validate() all read these tables.
//
// Guarantees:
//  1. Setting an option to a value of the wrong kind or out of range is an OptionError that names it.
//  2. get() returns a value that set() takes.
// Example:
//     assert(option_key("first-height") == "first_height" && numbers_above_up_to(0, 90).text() == "> 0 and <= 90");
//     assert(positive_numbers.contains(1e-300) && !positive_numbers.contains(0));
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/export.hpp>

namespace lamina {

/// The value of an option, as a case file or a script writes it.
using OptionValue = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

/// The kinds of values that options take.
enum class OptionKind {
    number,           ///< one number
    number_or_range,  ///< one number, or a range of numbers, as a word: "-4:18:1"
    number_or_word,   ///< one number, or a word
    length,           ///< one length: a number of chords, or a word such as "0.003u" for units of the input
    count,            ///< one whole number
    count_or_auto,    ///< one whole number, or the word "auto"
    flag,             ///< nothing on the command line; true or false in a case file
    word,             ///< one word
    words,            ///< several words, separated by commas on the command line
    repeated,         ///< one word each time the option is given
    path,             ///< one path
    paths,            ///< several paths
};

/// Returns the name of a kind, as it is written above: "count_or_auto".
LAMINA_EXPORT const char* option_kind_name(OptionKind kind);

/// A range of the numbers that an option may take. They are always finite.
struct LAMINA_EXPORT OptionRange {
    double lower = -HUGE_VAL;     ///< lower bound
    double upper = HUGE_VAL;      ///< upper bound, which belongs to the range
    bool includes_lower = false;  ///< whether the lower bound belongs to the range

    /// Returns whether the range holds a value; false for NaN and infinities.
    bool contains(double value) const;
    /// Returns the range in words: "> 0 and <= 90".
    std::string text() const;
};

/// All numbers above 0.
inline constexpr OptionRange positive_numbers{0, HUGE_VAL, false};
/// Returns the range of the numbers above a bound.
constexpr OptionRange numbers_above(double bound) { return {bound, HUGE_VAL, false}; }
/// Returns the range of the numbers above `lower` and up to `upper`.
constexpr OptionRange numbers_above_up_to(double lower, double upper) { return {lower, upper, false}; }
/// Returns the range of the numbers from `lower` to `upper`.
constexpr OptionRange numbers_from_to(double lower, double upper) { return {lower, upper, true}; }

/// Returns the name of an option as case files and scripts write it: "first_height" for "first-height".
LAMINA_EXPORT std::string option_key(const std::string& name);

/// One option of an options struct.
template <class Options>
struct Option {
    std::string name;     ///< as on the command line, without hyphens in front: "first-height"
    OptionKind kind;      ///< the kind of its values
    std::string metavar;  ///< what stands for the value in help: "H"
    std::string help;     ///< one sentence on the option's effect, with its unit
    std::string range;    ///< the values that it takes, in words; empty where the metavar says it
    /// Sets the option. Throws OptionError for values of the wrong kind or out of range.
    std::function<void(Options&, const OptionValue&)> set;
    /// Returns the value; empty where an option without default is not set.
    std::function<std::optional<OptionValue>(const Options&)> get;
    std::string group = {};                  ///< heading in help and in the guide
    std::vector<std::string> excludes = {};  ///< names of options that may not be given beside this one
    std::vector<std::string> needs = {};     ///< names of options that must be given beside this one
    bool library_only = false;               ///< neither on the command line nor in case files

    /// Returns the name as case files and scripts write it: "first_height".
    std::string key() const { return option_key(name); }
};

/// The options of one struct, in the order of the help.
template <class Options>
using OptionTable = std::vector<Option<Options>>;

/// Returns the table of an options struct, with names, ranges and help. That of CaseOptions has the rows of all stages,
/// which have tables of their own. Others are those of ConstrainedOptions, MeshCheckOptions, PlotOptions,
/// RemeshOptions, SolutionSizeOptions, SolverCaseOptions and TransitionOptions. A program that asks for another one
/// does not link.
template <class Options>
LAMINA_EXPORT const OptionTable<Options>& option_table();

/// Returns the row of this name. Precondition: the table has one.
template <class Options>
const Option<Options>& find_row(const OptionTable<Options>& table, const std::string& name) {
    return *std::find_if(table.begin(), table.end(), [&](const auto& option) { return option.name == name; });
}

/// Throws OptionError for a key that no option has. It names the one of `known` that was probably meant.
[[noreturn]] LAMINA_EXPORT void fail_unknown_key(const std::string& key, const std::vector<std::string>& known);

/// Returns the row of this key (Option::key()). Throws OptionError where the table has none.
template <class Options>
const Option<Options>& find_row_of_key(const OptionTable<Options>& table, const std::string& key) {
    const auto row = std::find_if(table.begin(), table.end(), [&](const auto& option) { return option.key() == key; });
    if (row != table.end()) return *row;
    std::vector<std::string> known;
    for (const Option<Options>& option : table) known.push_back(option.key());
    fail_unknown_key(key, known);
}

/// Throws OptionError unless every option of the table has a value that it could be set to.
template <class Options>
void require_in_range(const OptionTable<Options>& table, const Options& options) {
    for (const Option<Options>& option : table) {
        const std::optional<OptionValue> value = option.get(options);
        if (!value) continue;
        Options copy = options;
        option.set(copy, *value);
    }
}

/// Throws UsageError where options of the table were given that exclude each other, or one without another that it
/// needs. `given` are names of options.
template <class Options>
void require_consistent(const OptionTable<Options>& table, const std::vector<std::string>& given) {
    const auto is_given = [&](const std::string& name) {
        return std::find(given.begin(), given.end(), name) != given.end();
    };
    for (const Option<Options>& option : table) {
        if (!is_given(option.name)) continue;
        for (const std::string& other : option.excludes)
            if (is_given(other))
                throw UsageError(option.name + " and " + other + " exclude each other: give one of them");
        for (const std::string& other : option.needs)
            if (!is_given(other)) throw UsageError(option.name + " needs " + other + ", which is not given");
    }
}

/// Returns the table of an inner options struct as rows for the struct that holds it; member(outer) returns a reference
/// to the inner struct.
template <class Outer, class Inner, class Member>
OptionTable<Outer> nested_table(const OptionTable<Inner>& table, Member member) {
    OptionTable<Outer> result;
    for (const Option<Inner>& o : table)
        result.push_back({o.name, o.kind, o.metavar, o.help, o.range,
                          [set = o.set, member](Outer& outer, const OptionValue& value) { set(member(outer), value); },
                          [get = o.get, member](const Outer& outer) { return get(member(outer)); }, o.group, o.excludes,
                          o.needs, o.library_only});
    return result;
}

}  // namespace lamina
