// The part of text.hpp that reads text.
#include <algorithm>
#include <cmath>

#include <lamina/error.hpp>

#include "core/text.hpp"

namespace lamina::core {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        parts.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

void require_text(bool condition, const std::string& text, const std::string& reason) {
    if (!condition) throw UsageError("'" + text + "': " + reason);
}

double parse_number(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw UsageError("'" + text + "' is not a number");
    return value;
}

std::vector<double> parse_numbers(const std::string& text, char separator) {
    std::vector<double> numbers;
    for (const std::string& part : split(text, separator)) {
        try {
            numbers.push_back(parse_number(part));
        } catch (const UsageError& error) {
            throw UsageError("'" + text + "': " + error.what());
        }
    }
    return numbers;
}

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

}  // namespace lamina::core
