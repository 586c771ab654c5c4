#include "core/text.hpp"

#include <algorithm>
#include <cmath>

#include <lamina/error.hpp>

namespace lamina::core {

double parse_number(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw UsageError("'" + text + "' is not a number");
    return value;
}

std::vector<double> parse_numbers(const std::string& text, char separator) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        try {
            numbers.push_back(parse_number(text.substr(at, end - at)));
        } catch (const UsageError& error) {
            throw UsageError("'" + text + "': " + error.what());
        }
        at = end + 1;
    }
    return numbers;
}

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string extension_of(const std::filesystem::path& file) { return lower_case(file.extension().string()); }

}  // namespace lamina::core
