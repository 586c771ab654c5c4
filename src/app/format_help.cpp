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
    std::string text = "Formats (an extension stands for the first format that has it):";
    for (const MeshFormat& format : mesh_formats())
        text += fmt::format("\n  {:<15} {:<22} {}{}", format.name, fmt::to_string(fmt::join(format.extensions, " ")),
                            format.description, format.readable ? "" : " (written only)");
    return text;
}

}  // namespace lamina::app
