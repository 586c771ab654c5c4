#include <lamina/error.hpp>

#include <algorithm>
#include <utility>

#include "core/text.hpp"

namespace lamina::core {

namespace {

/// Returns the place and the reason as one line. Control characters, which a reason may quote from a damaged file,
/// become question marks.
std::string describe(const InputPlace& place, const std::string& reason) {
    std::string text;
    if (!place.file.empty()) text += place.file + ":";
    if (place.line > 0) text += concat(place.line, ":");
    if (!text.empty()) text += " ";
    text += reason;
    if (place.at) text += concat(" (at ", place.at->x, ", ", place.at->y, ")");
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
    return text;
}

}  // namespace

}  // namespace lamina::core

namespace lamina {

OptionError::OptionError(const std::string& option, const std::string& reason)
    : UsageError(option + ": " + reason), option_(option), reason_(reason) {}

InputError::InputError(InputPlace place, const std::string& reason)
    : Error(ExitCode::bad_input, core::describe(place, reason)), place_(std::move(place)), reason_(reason) {}

IoError::IoError(const std::string& file, const std::string& reason)
    : Error(ExitCode::io_failed, file + ": " + reason), file_(file), reason_(reason) {}

}  // namespace lamina
