// lamina plot: draws a picture of a mesh.
#include <memory>
#include <string>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/plot.hpp>

#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/run_files.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct PlotArguments {
    std::string mesh, mesh_format;
    std::string picture;
    std::string window, color, width, format;
};

}  // namespace

void add_plot_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("plot", "draw a picture of a mesh");
    auto arguments = std::make_shared<PlotArguments>();
    command->add_option("MESH", arguments->mesh, "mesh file; - for standard input")->required();
    add_input_format(*command, arguments->mesh_format);
    command
        ->add_option("-o,--output", arguments->picture,
                     "picture; its extension says the format: .png, .svg or .pdf; - for standard output")
        ->required()
        ->type_name("FILE");
    add_table_option(*command, plot_option_table(), "window", arguments->window);
    add_table_option(*command, plot_option_table(), "color", arguments->color);
    add_table_option(*command, plot_option_table(), "width", arguments->width);
    add_table_option(*command, plot_option_table(), "format", arguments->format);
    command->callback([arguments] {
        PlotOptions options;
        set_by_name(plot_option_table(), "window", arguments->window, options);
        set_by_name(plot_option_table(), "color", arguments->color, options);
        set_by_name(plot_option_table(), "width", arguments->width, options);
        set_by_name(plot_option_table(), "format", arguments->format, options);
        require_format(arguments->mesh, arguments->mesh_format, "--input-format");
        require_format(arguments->picture, arguments->format, "--format");
        const std::vector<RunFile> outputs{{arguments->picture, "option --output"}};
        require_distinct(files_of_mesh(arguments->mesh, arguments->mesh_format), outputs);
        const SignalGuard guard(outputs);
        plot_mesh(read_mesh(arguments->mesh, {.format = arguments->mesh_format}), arguments->picture, options);
    });
}

}  // namespace lamina::app
