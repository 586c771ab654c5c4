// lamina_options_page: prints docs/options.md, the table of the options of `lamina mesh`. ./dev docs writes the page,
// and a test compares it.
#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "app/options.hpp"

namespace lamina::app {

namespace {

/// Returns what a command line holds for the option: "--first-height H".
std::string usage_text(const Option<MeshCase>& option) {
    if (option.name == "input") return option.metavar;
    if (option.name == "output") return "-o, --output " + option.metavar;
    return "--" + option.name + (option.metavar.empty() ? "" : " ") + option.metavar;
}

/// Returns a text in which no line ends a cell of a table.
std::string escaped(std::string cell) {
    for (std::size_t at = 0; (at = cell.find('|', at)) != std::string::npos; at += 2) cell.replace(at, 1, "\\|");
    return cell;
}

std::string options_page() {
    std::string text =
        "# Options of `lamina mesh`\n\n"
        "`./dev docs` writes this page from the tables of the program. Case files use the same names with underscores "
        "for hyphens. Lengths are numbers of chords (`--chord`), or of units of the input with the suffix `u`: "
        "`0.003u`. Positions are in units of the input, and angles in degrees.\n";
    std::string_view group;
    for (const Option<MeshCase>& option : mesh_options()) {
        if (option.group != group) {
            group = option.group;
            text += fmt::format("\n## {}\n\n| option | default | meaning |\n|---|---|---|\n", group);
        }
        text += fmt::format("| `{}` | {} | {} |\n", escaped(usage_text(option)), default_text(option),
                            escaped(help_with_range(option)));
    }
    return text;
}

}  // namespace

}  // namespace lamina::app

int main() { std::fputs(lamina::app::options_page().c_str(), stdout); }
