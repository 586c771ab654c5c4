#include <lamina/option.hpp>

#include <algorithm>

#include <lamina/option_builders.hpp>
#include "core/text.hpp"

namespace lamina {

std::string option_key(const std::string& name) {
    std::string key = name;
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

bool OptionRange::contains(double value) const {
    const bool above = with_lower ? value >= lower : value > lower;
    return std::isfinite(value) && above && value <= upper;
}

std::string OptionRange::text() const {
    const std::string from = core::concat(with_lower ? ">= " : "> ", lower);
    return std::isinf(upper) ? from : core::concat(from, " and <= ", upper);
}

double number_of(const OptionValue& value, const std::string& option) {
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
    throw OptionError(option, "must be a number");
}

std::int64_t count_of(const OptionValue& value, const std::string& option) {
    if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
    throw OptionError(option, "must be a whole number");
}

bool flag_of(const OptionValue& value, const std::string& option) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag;
    throw OptionError(option, "must be true or false");
}

std::string word_of(const OptionValue& value, const std::string& option) {
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    throw OptionError(option, "must be a string");
}

std::string word_or_number_of(const OptionValue& value, const std::string& option) {
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    return core::to_text(number_of(value, option));
}

std::vector<std::string> words_of(const OptionValue& value, const std::string& option) {
    if (const auto* words = std::get_if<std::vector<std::string>>(&value)) return *words;
    if (const auto* word = std::get_if<std::string>(&value)) return {*word};
    throw OptionError(option, "must be an array of strings");
}

void require_in(const OptionRange& range, double value, const std::string& option) {
    if (!range.contains(value))
        throw OptionError(option, core::concat(value, " is out of range: must be ", range.text()));
}

}  // namespace lamina
