// Text within HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace lamina::core {

/// Returns the text as it stands between tags, or in an attribute between double quotes.
inline std::string escaped_markup(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

}  // namespace lamina::core
