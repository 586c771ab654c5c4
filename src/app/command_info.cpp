// lamina info: what was read, detected and repaired.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <lamina/pipeline.hpp>

#include "app/case.hpp"
#include "app/commands.hpp"

namespace lamina::app {

void add_info_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "what was read, detected and repaired");
    auto inputs = std::make_shared<std::vector<std::string>>();
    command->add_option("INPUT", *inputs, "airfoil files, naca:DIGITS[:POINTS][:blunt], or one case file (.toml)");
    command->callback([inputs] {
        const MeshCase mesh_case = case_of_inputs(*inputs);
        Pslg pslg = read_geometry(mesh_case.inputs, mesh_case.options.geometry);
        const CaseOptions options = options_in_force(pslg, case_options(mesh_case));
        fmt::print("{}", describe(prepare_surfaces(std::move(pslg), surface_options(options))));
    });
}

}  // namespace lamina::app
