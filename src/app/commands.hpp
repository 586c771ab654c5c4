// The commands of the program, one per file. Each function adds a command to the command line; the command runs when it
// is named there.
#pragma once

#include <lamina/ranks.hpp>

#include "app/command_line.hpp"

namespace lamina::app {

/// `ranks`: the processes that make the mesh together; null: this one alone.
void add_mesh_command(CLI::App& app, Ranks* ranks);
void add_family_command(CLI::App& app);
void add_sizes_command(CLI::App& app);
void add_remesh_command(CLI::App& app);
void add_adapt_command(CLI::App& app);
void add_morph_command(CLI::App& app);
void add_batch_command(CLI::App& app);
void add_case_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_plot_command(CLI::App& app);
void add_view_command(CLI::App& app);
void add_convert_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_flow_command(CLI::App& app);
void add_polar_command(CLI::App& app);
void add_yplus_command(CLI::App& app);
void add_delaunay_command(CLI::App& app);
void add_completion_command(CLI::App& app);

}  // namespace lamina::app
