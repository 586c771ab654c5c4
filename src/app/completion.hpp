// Scripts that complete the command line in shells.
#pragma once

#include <string>
#include <vector>

#include "app/command_facts.hpp"

namespace lamina::app {

/// Return the script for one shell, with every option of every command.
std::string bash_completion(const std::vector<CommandFacts>& commands);
std::string zsh_completion(const std::vector<CommandFacts>& commands);
std::string fish_completion(const std::vector<CommandFacts>& commands);

}  // namespace lamina::app
