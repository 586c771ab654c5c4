#include "app/format_help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/io.hpp>

namespace lamina::app {

std::string format_names() {
    std::string names;
    for (const MeshFormat& format : mesh_formats()) names += (names.empty() ? "" : "|") + format.name;
    return names;
}

std::string format_help() {
    std::string text = "Formats (an extension stands for the first that has it):";
    for (const MeshFormat& format : mesh_formats())
        text += fmt::format("\n  {:<15} {:<20} {}{}", format.name, fmt::join(format.extensions, " "), format.holds,
                            format.readable ? "" : " (written only)");
    return text;
}

}  // namespace lamina::app
