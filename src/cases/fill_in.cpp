#include <algorithm>
#include <cassert>

#include "cases/templates.hpp"

namespace lamina::cases {

namespace {

/// Returns the name of the placeholder that the text begins with, empty where it begins with another "@".
std::string_view placeholder_at(std::string_view text) {
    const auto in_name = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto end = std::find_if_not(text.begin() + 1, text.end(), in_name);
    if (end == text.end() || *end != '@') return {};
    return text.substr(1, static_cast<std::size_t>(end - text.begin()) - 1);
}

}  // namespace

std::string fill_in(std::string_view text, const Words& words) {
    std::string filled;
    while (!text.empty()) {
        const std::size_t at = std::min(text.find('@'), text.size());
        filled += text.substr(0, at);
        text.remove_prefix(at);
        if (text.empty()) break;
        const std::string_view name = placeholder_at(text);
        if (name.empty()) {
            filled += '@';
            text.remove_prefix(1);
            continue;
        }
        const auto word = words.find(name);
        assert(word != words.end());
        filled += word->second;
        text.remove_prefix(name.size() + 2);
    }
    return filled;
}

}  // namespace lamina::cases
