#include "app/man_page.hpp"

#include <string_view>

#include <fmt/format.h>

#include <lamina/version.hpp>

namespace lamina::app {

namespace {

/// Returns text in which groff finds no commands. A minus sign stays one, so that options can be copied.
std::string roff(std::string_view text) {
    std::string result;
    bool at_line_start = true;
    for (const char c : text) {
        if (at_line_start && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
        at_line_start = c == '\n';
    }
    return result;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

/// Returns the value as it is typed: words as they are, and names of values in italics.
std::string value_text(const OptionFacts& option) {
    return option.choices.empty() ? italic(option.value) : roff(option.value);
}

/// Returns a paragraph with what stands in the margin, and the help.
std::string option_entry(const OptionFacts& option) {
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
    if (!option.value.empty()) names += " " + value_text(option);
    return fmt::format(".TP\n{}\n{}\n", names, roff(option.help));
}

std::string argument_entry(const OptionFacts& argument) {
    return fmt::format(".TP\n{}\n{}\n", value_text(argument), roff(argument.help));
}

/// Returns "lamina mesh [options] INPUT...".
std::string synopsis(const CommandFacts& command) {
    std::string line = bold("lamina " + command.name);
    if (!command.options.empty()) line += " [" + italic("options") + "]";
    for (const OptionFacts& argument : command.arguments)
        line += " " + value_text(argument) + (argument.repeats ? " ..." : "");
    return line;
}

std::string command_section(const CommandFacts& command) {
    std::string text = fmt::format(".SS {}\n{}\n.PP\n{}.\n", bold(command.name), synopsis(command), roff(command.help));
    for (const OptionFacts& argument : command.arguments) text += argument_entry(argument);
    std::string_view group;
    for (const OptionFacts& option : command.options) {
        const bool has_groups = option.group != "Options";
        if (has_groups && option.group != group) text += fmt::format(".PP\n{}\n", italic(option.group));
        group = option.group;
        text += option_entry(option);
    }
    return text;
}

/// Returns lines that are shown as they stand.
std::string example(std::string_view lines) { return fmt::format(".PP\n.nf\n{}\n.fi\n", roff(lines)); }

constexpr const char* examples =
    "lamina mesh naca:0012 --y-plus 1 --reynolds 6e6 -o naca0012.su2\n"
    "lamina mesh slat.dat main.dat flap.dat --layers auto -o highlift.cgns --report highlift.json\n"
    "lamina case openfoam naca:0012:extended --reynolds 6e6 --alpha 10 -o naca0012\n"
    "lamina mesh case.toml --growth 1.1 -o finer.vtu\n"
    "lamina check finer.vtu --require-delaunay\n"
    "lamina mesh naca:2412 -o - --format su2 | lamina check - --input-format su2";

struct ExitCodeText {
    int code;
    const char* meaning;
};
constexpr ExitCodeText exit_codes[] = {
    {0, "done"},
    {2, "wrong usage"},
    {3, "bad input"},
    {4, "no mesh of the promised standard could be made, or a checked mesh is not as required"},
    {5, "reading or writing failed"}};

}  // namespace

std::string man_page(const std::vector<CommandFacts>& commands) {
    std::string text = fmt::format(
        ".\\\" `lamina completion man` prints this page.\n.TH LAMINA 1 \"\" \"lamina {}\" "
        "\"User Commands\"\n.SH NAME\nlamina \\- {}\n.SH SYNOPSIS\n",
        LAMINA_VERSION, roff("two-dimensional viscous meshes round airfoils"));
    for (const CommandFacts& command : commands) text += synopsis(command) + "\n.br\n";
    text += bold("lamina help") + " [" + italic("command") + "]\n.br\n" + bold("lamina --version") + "\n";
    text += ".SH DESCRIPTION\n";
    text += roff(
        "lamina makes meshes for viscous flow around airfoils: a boundary layer of thin cells along the walls, and "
        "graded Delaunay triangles out to the far field. Lengths are numbers of chords (--chord), or of units of the "
        "input with the suffix u: 0.003u. Positions are in units of the input, and angles in degrees. The name - "
        "stands for standard input and for standard output.\n");
    text += ".SH COMMANDS\n";
    for (const CommandFacts& command : commands) text += command_section(command);
    for (const CommandFacts& command : commands)
        if (command.name == "mesh" && !command.footer.empty()) text += ".SH FORMATS\n" + example(command.footer);
    text += ".SH EXIT STATUS\n";
    for (const ExitCodeText& code : exit_codes) text += fmt::format(".TP\n.B {}\n{}\n", code.code, roff(code.meaning));
    return text + ".SH EXAMPLES\n" + example(examples);
}

}  // namespace lamina::app
