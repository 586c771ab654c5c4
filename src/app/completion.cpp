#include "app/completion.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lamina::app {

namespace {

constexpr const char* help_of_help = "show the help of the program or of a command";

/// Returns the text with a backslash before each of these characters.
std::string escaped(std::string_view text, std::string_view special) {
    std::string result;
    for (const char c : text) {
        if (special.find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
    return result;
}

std::vector<std::string> names_of(const std::vector<CommandFacts>& commands) {
    std::vector<std::string> names(commands.size());
    std::transform(commands.begin(), commands.end(), names.begin(), [](const CommandFacts& c) { return c.name; });
    names.emplace_back("help");
    return names;
}

// --- zsh

/// Returns text for a word in single quotes in which _arguments and _describe give brackets and colons a meaning.
std::string zsh_text(std::string_view text) {
    std::string result;
    for (const char c : escaped(text, "\\[]:")) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result;
}

/// Returns ":VALUE:what completes it"; nothing for a flag.
std::string zsh_value(const OptionFacts& option) {
    if (option.value.empty()) return {};
    std::string completed = option.takes_file ? "_files" : " ";
    if (!option.choices.empty()) completed = fmt::format("({})", fmt::join(option.choices, " "));
    return fmt::format(":{}:{}", zsh_text(option.choices.empty() ? option.value : "value"), completed);
}

std::string zsh_arguments(const CommandFacts& command) {
    std::string text;
    for (const OptionFacts& option : command.options)
        for (const std::string& name : option.names)
            text += fmt::format(" \\\n        '{}{}[{}]{}'", option.repeats ? "*" : "", name, zsh_text(option.help),
                                zsh_value(option));
    for (const OptionFacts& argument : command.arguments)
        text += fmt::format(" \\\n        '{}{}'", argument.repeats ? "*" : "", zsh_value(argument));
    return text;
}

// --- fish

std::string fish_text(std::string_view text) { return "'" + escaped(text, "\\'") + "'"; }

std::string fish_option(const CommandFacts& command, const OptionFacts& option) {
    std::string line = fmt::format("complete -c lamina -n '__fish_seen_subcommand_from {}'", command.name);
    for (const std::string& name : option.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.value.empty()) line += option.takes_file ? " -r -F" : " -x";
    if (!option.choices.empty()) line += " -a " + fish_text(fmt::format("{}", fmt::join(option.choices, " ")));
    return line + " -d " + fish_text(option.help) + "\n";
}

}  // namespace

std::string bash_completion(const std::vector<CommandFacts>& commands) {
    std::string options, values;
    for (const CommandFacts& command : commands) {
        options += fmt::format("        {}) words='{}' ;;\n", command.name, fmt::join(option_names(command), " "));
        for (const OptionFacts& option : command.options)
            for (const std::string& name : option.names)
                if (!option.choices.empty())
                    values += fmt::format("        {},{}) words='{}' ;;\n", command.name, name,
                                          fmt::join(option.choices, " "));
        for (const OptionFacts& argument : command.arguments)
            if (!argument.choices.empty())
                values += fmt::format("        {},{}) words='{}' ;;\n", command.name, command.name,
                                      fmt::join(argument.choices, " "));
    }
    const std::string names = fmt::format("{}", fmt::join(names_of(commands), " "));
    std::string text = "# Completes the command line of lamina in bash; `lamina completion bash` prints this file.\n";
    text += "_lamina() {\n    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=\n";
    text += "    if [[ $COMP_CWORD -eq 1 || ${COMP_WORDS[1]} == help ]]; then\n";
    text += fmt::format("        words='{} --help --version'\n", names);
    text +=
        "    elif [[ $word == -* ]]; then\n        case ${COMP_WORDS[1]} in\n" + options + "        esac\n    else\n";
    text += "        case ${COMP_WORDS[1]},$before in\n" + values + "        esac\n    fi\n";
    text += "    COMPREPLY=()\n    while IFS= read -r word; do COMPREPLY+=(\"$word\"); done \\\n";
    text += "        < <(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\")\n}\n";
    text += "# Without a word to offer, names of files are completed.\ncomplete -o default -F _lamina lamina\n";
    return text;
}

std::string zsh_completion(const std::vector<CommandFacts>& commands) {
    std::string text =
        "#compdef lamina\n# Completes the command line of lamina in zsh; `lamina completion zsh` prints this file.\n"
        "_lamina() {\n    local -a commands=(\n";
    for (const CommandFacts& command : commands)
        text += fmt::format("        '{}:{}'\n", command.name, zsh_text(command.help));
    text += fmt::format("        'help:{}'\n    )\n", help_of_help);
    text += "    if (( CURRENT == 2 )) || [[ $words[2] == help ]]; then\n        _describe command commands\n";
    text += "        return\n    fi\n    local command=$words[2]\n    shift words\n    (( CURRENT-- ))\n";
    text += "    case $command in\n";
    for (const CommandFacts& command : commands)
        text += fmt::format("    {})\n        _arguments -s{} ;;\n", command.name, zsh_arguments(command));
    return text +
           "    esac\n}\nif [[ $funcstack[1] == _lamina ]]; then\n    _lamina \"$@\"\nelse\n"
           "    compdef _lamina lamina\nfi\n";
}

std::string fish_completion(const std::vector<CommandFacts>& commands) {
    std::string text =
        "# Completes the command line of lamina in fish; `lamina completion fish` prints this file.\n"
        "complete -c lamina -n __fish_use_subcommand -f\n";
    for (const CommandFacts& command : commands)
        text += fmt::format("complete -c lamina -n __fish_use_subcommand -a {} -d {}\n", command.name,
                            fish_text(command.help));
    text += fmt::format("complete -c lamina -n __fish_use_subcommand -a help -d {}\n", fish_text(help_of_help));
    text += "complete -c lamina -n __fish_use_subcommand -l help -d 'show the help'\n";
    text += "complete -c lamina -n __fish_use_subcommand -s V -l version -d 'show the version'\n";
    text += fmt::format("complete -c lamina -n '__fish_seen_subcommand_from help' -f -a '{}'\n",
                        fmt::join(names_of(commands), " "));
    for (const CommandFacts& command : commands) {
        for (const OptionFacts& option : command.options) text += fish_option(command, option);
        for (const OptionFacts& argument : command.arguments)
            if (!argument.choices.empty())
                text += fmt::format("complete -c lamina -n '__fish_seen_subcommand_from {}' -f -a '{}'\n", command.name,
                                    fmt::join(argument.choices, " "));
    }
    return text;
}

}  // namespace lamina::app
