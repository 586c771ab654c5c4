// lamina morph: the same mesh round other shapes.
#include <memory>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/morph_run.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct MorphArguments {
    MorphSettings settings;
    std::vector<std::string> transformations;  ///< texts that parse_transformation() reads
};

/// Throws UsageError where a text is no transformation.
MorphSettings settings_of(const MorphArguments& arguments) {
    MorphSettings settings = arguments.settings;
    set_by_name(option_table<GeometryOptions>(), "transform", arguments.transformations, settings.geometry);
    return settings;
}

}  // namespace

void add_morph_command(CLI::App& app) {
    CLI::App* command = add_command(app, "morph", "move a mesh to other shapes of its bodies, with the same cells");
    auto arguments = std::make_shared<MorphArguments>();
    add_option(*command, "MESH", arguments->settings.mesh,
               "mesh file, or a case file (.toml), whose mesh is made first")
        .required();
    add_input_format(*command, arguments->settings.mesh_format);
    add_option(*command, "--to", arguments->settings.shapes,
               "airfoil files or naca:DIGITS, one for each body, in the order of the bodies of the mesh; vertices "
               "keep their shares of the arc length between corners")
        .type_name("SHAPE...");
    add_repeated_table_option(*command, option_table<GeometryOptions>(), "transform", arguments->transformations)
        .description("change the bodies, which are named by their markers, or the shapes of --to: as for lamina mesh");
    add_option(*command, "--displacements", arguments->settings.displacements,
               "CSV file with a line 'vertex,dx,dy' for each wall vertex that moves, numbered as --wall-data of "
               "lamina mesh does")
        .type_name("FILE");
    add_option(*command, "--sequence", arguments->settings.sequence.turns,
               "bodies that turn as time goes on: ELEMENT:pitch:MEAN:AMPLITUDE:FREQUENCY[:X,Y] by mean + amplitude "
               "sin(2 pi frequency time), or ELEMENT:deflect:DEG:DURATION[:X,Y] from rest to rest; degrees, nose up, "
               "about the origin or X,Y; may be given several times. NEW is a case of OpenFOAM or, with --format su2 "
               "where the whole mesh pitches, of SU2, or holds {step}")
        .type_name("TURN")
        .repeated();
    add_option(*command, "--until", arguments->settings.sequence.until,
               "time at which the sequence ends; else the longest period or duration")
        .needs("--sequence")
        .type_name("TIME");
    add_option(*command, "--steps", arguments->settings.sequence.steps,
               "number of times of the sequence after the first one")
        .in_range(1, 100'000)
        .needs("--sequence")
        .show_default()
        .type_name("N");
    add_flag(*command, "--as-far-as-possible", arguments->settings.morph.as_far_as_possible,
             "write a mesh that gets only a part of the way, since a cell would turn over beyond it");
    add_flag(*command, "--incremental", arguments->settings.morph.incremental,
             "where a cell would turn over, go on from a mesh half as far, in as many steps as it takes");
    add_flag(*command, "--reconnect", arguments->settings.reconnect,
             "swap diagonals and move vertices beyond the layer afterwards, where triangles get better: the cells are "
             "no longer those of MESH")
        .excludes("--sequence");
    add_option(*command, "-o,--output", arguments->settings.output, "mesh file to write").required().type_name("NEW");
    add_option(*command, "--format", arguments->settings.write.format, "format of NEW").type_name(format_names());
    add_option(*command, "--report", arguments->settings.report, "JSON file to write: the quality before and after")
        .type_name("FILE");
    set_footer(*command, format_help());
    run_with(*command, [arguments] { run_morph(settings_of(*arguments)); });
}

}  // namespace lamina::app
