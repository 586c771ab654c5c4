#include <lamina/option.hpp>

#include <algorithm>
#include <cmath>

#include "core/length.hpp"
#include "core/option_builders.hpp"
#include "core/suggestion.hpp"
#include "core/text.hpp"

namespace lamina {

std::string option_key(const std::string& name) {
    std::string key = name;
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

const char* option_kind_name(OptionKind kind) {
    switch (kind) {
        case OptionKind::number:
            return "number";
        case OptionKind::number_or_range:
            return "number_or_range";
        case OptionKind::number_or_word:
            return "number_or_word";
        case OptionKind::length:
            return "length";
        case OptionKind::count:
            return "count";
        case OptionKind::count_or_auto:
            return "count_or_auto";
        case OptionKind::flag:
            return "flag";
        case OptionKind::word:
            return "word";
        case OptionKind::words:
            return "words";
        case OptionKind::repeated:
            return "repeated";
        case OptionKind::path:
            return "path";
        case OptionKind::paths:
            return "paths";
    }
    return "";
}

void fail_unknown_key(const std::string& key, const std::vector<std::string>& known) {
    throw OptionError(key, "no such option" + did_you_mean(meant_option(key, known)));
}

bool OptionRange::contains(double value) const {
    const bool above = includes_lower ? value >= lower : value > lower;
    return std::isfinite(value) && above && value <= upper;
}

std::string OptionRange::text() const {
    const std::string from = core::concat(includes_lower ? ">= " : "> ", lower);
    return std::isinf(upper) ? from : core::concat(from, " and <= ", upper);
}

double as_number(const OptionValue& value, const std::string& option) {
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
    throw OptionError(option, "must be a number");
}

Length as_length(const OptionValue& value, const std::string& option) {
    const auto* word = std::get_if<std::string>(&value);
    if (!word) return as_number(value, option);
    try {
        return core::parse_length(*word);
    } catch (const UsageError& error) {
        throw OptionError(option, error.what());
    }
}

ValueRange as_range(const OptionValue& value, const std::string& option) {
    const auto* word = std::get_if<std::string>(&value);
    if (!word || !is_range(*word)) throw OptionError(option, "must be a number, or a range A:B or A:B:STEP");
    try {
        return parse_range(*word);
    } catch (const UsageError& error) {
        throw OptionError(option, error.what());
    }
}

OptionValue option_value(Length length) {
    if (length.unit == LengthUnit::chord) return length.value;
    return core::length_text(length);
}

std::int64_t as_count(const OptionValue& value, const std::string& option) {
    if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
    // 2e9 is a real number to TOML and Python. Above this, doubles leave whole numbers out.
    constexpr double greatest = 0x1p53;
    if (const auto* real = std::get_if<double>(&value);
        real && std::abs(*real) <= greatest && std::trunc(*real) == *real)
        return static_cast<std::int64_t>(*real);
    throw OptionError(option, "must be a whole number");
}

bool as_flag(const OptionValue& value, const std::string& option) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag;
    throw OptionError(option, "must be true or false");
}

std::string as_word(const OptionValue& value, const std::string& option) {
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    throw OptionError(option, "must be a string");
}

std::string as_word_or_number(const OptionValue& value, const std::string& option) {
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    return core::to_text(as_number(value, option));
}

std::vector<std::string> as_words(const OptionValue& value, const std::string& option) {
    if (const auto* words = std::get_if<std::vector<std::string>>(&value)) return *words;
    if (const auto* word = std::get_if<std::string>(&value)) return {*word};
    throw OptionError(option, "must be an array of strings");
}

std::vector<std::string> as_words_or_number(const OptionValue& value, const std::string& option) {
    if (std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value))
        return {as_word_or_number(value, option)};
    return as_words(value, option);
}

std::string unknown_choice(const std::string& word, const std::vector<std::string>& names) {
    std::string known;
    for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
    return "'" + word + "' is not known" + did_you_mean(closest_word(word, names)) + " (known: " + known + ")";
}

void require_in_range(const OptionRange& range, double value, const std::string& option) {
    if (!range.contains(value))
        throw OptionError(option, core::concat(value, " is out of range: must be ", range.text()));
}

}  // namespace lamina
