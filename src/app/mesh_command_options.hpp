// The options of `lamina mesh` on the command line: every command that makes meshes takes them all.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lamina/option.hpp>
#include <lamina/pipeline.hpp>

#include "app/case.hpp"
#include "app/command_line.hpp"

namespace lamina::app {

/// The options of the table, each with the option of CLI11 that reads it from the command line.
using GivenOptions = std::vector<std::pair<const Option<MeshCase>*, CLI::Option*>>;

/// Adds the options of `lamina mesh` to a command, INPUT among them, but for those of these names.
GivenOptions add_mesh_options(CLI::App& command, const std::vector<std::string_view>& left_out = {});

/// Returns what was given for the option of this name; nothing where it was not given.
std::vector<std::string> given_texts(const GivenOptions& options, const std::string& name);

/// Returns the case that the command line describes. Its options override those of the case file.
MeshCase case_of_command_line(const GivenOptions& options);

/// An option, and the text of its value.
using OptionText = std::pair<const Option<MeshCase>*, std::string>;

/// Returns the case that the command line describes with these INPUTs in place of its own. The further options override
/// those of the command line.
MeshCase case_of_command_line(const GivenOptions& options, const std::vector<std::string>& inputs,
                              const std::vector<OptionText>& further);

}  // namespace lamina::app
