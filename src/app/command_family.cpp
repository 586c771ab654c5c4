// lamina family: makes similar meshes, for a study of convergence.
#include <memory>

#include <lamina/error.hpp>

#include "app/commands.hpp"
#include "app/family_run.hpp"
#include "app/format_help.hpp"
#include "app/mesh_command_options.hpp"
#include "app/mesh_run.hpp"

namespace lamina::app {

void add_family_command(CLI::App& app) {
    CLI::App* command = add_command(app, "family", "make similar meshes, each finer than the one before");
    auto options = std::make_shared<const GivenOptions>(add_mesh_options(*command));
    auto arguments = add_family_options(*command, 4);
    set_footer(
        *command,
        "In names of output files, {level} stands for the number of the level. From level to level all lengths are "
        "divided by the ratio: edges of walls, sizes, first heights and layers, angles between rays, gradations, "
        "changes of the pressure from vertex to vertex, and triangles across wakes. Layers keep their total height. "
        "Walls are resampled on every level (--surface resample). h is the root of the mean area of the cells, the "
        "length that Richardson extrapolation takes.\n\n" +
            format_help());
    run_with(*command, [options, arguments] {
        MeshCase mesh_case = case_of_command_line(*options);
        if (mesh_case.outputs.empty()) throw UsageError("no output: give -o NAME_{level}.EXTENSION");
        prefer_quads_for_openfoam(mesh_case);
        run_family(*arguments, mesh_case, destination_of_outputs);
    });
}

}  // namespace lamina::app
