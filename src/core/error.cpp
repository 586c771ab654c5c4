#include <lamina/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace lamina {

namespace {

std::string describe(const InputPlace& place, const std::string& reason) {
    std::string text;
    if (!place.file.empty()) text += place.file + ":";
    if (place.line > 0) text += fmt::format("{}:", place.line);
    if (!text.empty()) text += " ";
    text += reason;
    if (place.at) text += fmt::format(" (at {}, {})", place.at->x, place.at->y);
    // One line, whatever a damaged file made the reason quote.
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
    return text;
}

}  // namespace

InputError::InputError(InputPlace place, const std::string& reason)
    : Error(ExitCode::bad_input, describe(place, reason)), place_(std::move(place)) {}

IoError::IoError(const std::string& file, const std::string& reason)
    : Error(ExitCode::io_failed, file + ": " + reason) {}

}  // namespace lamina
