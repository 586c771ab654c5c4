// The commands and their options as data, for what is generated from them: completion scripts and the manual page.
#pragma once

#include <string>
#include <vector>

#include "app/command_line.hpp"

namespace lamina::app {

struct OptionFacts {
    std::vector<std::string> names;    ///< with their hyphens: "-o", "--output"; one without hyphens for an argument
    std::string value;                 ///< what stands for the value in help; empty for a flag
    std::string help;                  ///< one sentence
    std::string group;                 ///< heading in help
    std::vector<std::string> choices;  ///< the words that the value may be, where the value's name lists them
    bool takes_file = false;           ///< whether the value is the name of a file or folder
    bool repeats = false;              ///< whether it may be given several times
};

struct CommandFacts {
    std::string name;
    std::string help;
    std::string footer;
    std::vector<OptionFacts> arguments;  ///< in their order
    std::vector<OptionFacts> options;    ///< in the order of the help, with --help
};

/// Returns the commands that the help shows, in its order.
std::vector<CommandFacts> facts_of_commands(const CLI::App& app);

/// Returns the names of a command's options with their hyphens, in one list.
std::vector<std::string> option_names(const CommandFacts& command);

}  // namespace lamina::app
