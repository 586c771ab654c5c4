// Options of the commands that solve flow and boundary layers together.
#pragma once

#include <map>
#include <string>

#include <lamina/coupled_flow.hpp>

#include "app/command_line.hpp"

namespace lamina::app {

/// Adds the options of transition to a command; `texts` receives their values by their names.
void add_transition_options(CLI::App& command, std::map<std::string, std::string>& texts);
/// Returns the options of these texts. Throws UsageError for wrong ones.
TransitionOptions transition_options(const std::map<std::string, std::string>& texts);

}  // namespace lamina::app
