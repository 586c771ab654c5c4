// The manual page.
#pragma once

#include <string>
#include <vector>

#include "app/command_facts.hpp"

namespace lamina::app {

/// Returns the page lamina(1) in the macros of man(7).
std::string man_page(const std::vector<CommandFacts>& commands);

}  // namespace lamina::app
