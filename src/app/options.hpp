// The one table of the options of `lamina mesh`: the command line, case.toml, --help and --dump-config all read it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <lamina/error.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// A value as it stands in case.toml.
using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

/// What an option takes: one number, one whole number, one whole number or "auto", nothing, one word, several words
/// (separated by commas), one word that may hold commas each time it is given, one path, several paths.
enum class Kind { real, count, count_or_auto, flag, word, words, repeated, path, paths };

struct Option {
    std::string name;  ///< "first-height"
    Kind kind;
    std::string metavar;
    std::string help;  ///< with unit and range
    /// Throws UsageError with the bare reason.
    std::function<void(MeshCase&, const Value&)> set;
    /// Empty where an option without default is not set.
    std::function<std::optional<Value>(const MeshCase&)> get;
    std::string group = {};  ///< heading in --help

    std::string key() const;           ///< in case.toml: "first_height"
    std::string command_line() const;  ///< as CLI11 wants it: "--first-height", "-o,--output", "INPUT"
};

const std::vector<Option>& mesh_options();

/// Sets the option. Throws UsageError "origin: reason".
void assign(const Option& option, MeshCase& mesh_case, const Value& value, const std::string& origin);

/// The value that arguments from the command line spell. Throws UsageError "origin: reason".
Value value_of_text(Kind kind, const std::vector<std::string>& texts, const std::string& origin);

/// Throws UsageError "origin: reason".
double parse_real(const std::string& text, const std::string& origin);

/// What a person reads: "0.1", "fan", "a,b"; empty lists give an empty text.
std::string to_text(const Value& value);

template <class Choice>
using Choices = std::vector<std::pair<std::string, Choice>>;

/// The choice of this name. Throws UsageError, "origin: " in front where one is given, with the names there are.
template <class Choice>
Choice choose(const std::string& text, const Choices<Choice>& choices, const std::string& origin = "") {
    std::string known;
    for (const auto& [name, choice] : choices) {
        if (name == text) return choice;
        known += (known.empty() ? "" : ", ") + name;
    }
    throw UsageError((origin.empty() ? "" : origin + ": ") + "'" + text + "' is not known; known: " + known);
}

}  // namespace lamina::app
