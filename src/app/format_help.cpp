#include "app/format_help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/io.hpp>

namespace lamina::app {

namespace {

/// Returns the names of the formats that are selected, with bars between them.
template <class Select>
std::string names_of_formats(Select select) {
    std::string names;
    for (const MeshFormat& format : mesh_formats())
        if (select(format)) names += (names.empty() ? "" : "|") + format.name;
    return names;
}

}  // namespace

void add_input_format(CLI::App& command, std::string& format) {
    add_option(command, "--input-format", format, "format of the mesh that is read; else its extension says it")
        .type_name(names_of_formats([](const MeshFormat& row) { return row.readable; }));
}

std::string format_names() {
    return names_of_formats([](const MeshFormat&) { return true; });
}

std::string format_help() {
    std::string text = "Formats (an extension stands for the first format that has it):";
    for (const MeshFormat& format : mesh_formats())
        text += fmt::format("\n  {:<15} {:<22} {}{}", format.name, fmt::to_string(fmt::join(format.extensions, " ")),
                            format.description, format.readable ? "" : " (written only)");
    return text;
}

}  // namespace lamina::app
