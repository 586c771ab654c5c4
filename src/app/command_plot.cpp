// lamina plot: draws a picture of a mesh, or of the outline of an airfoil.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/io.hpp>
#include <lamina/plot.hpp>

#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct PlotArguments {
    std::string mesh, mesh_format;
    std::string picture;
    std::string window, color, repeat, width, format;
    bool axes = false, scale_bar = false, color_bar = false;
};

/// Returns whether the name is that of an airfoil: a NACA section, or a file of coordinates.
bool names_airfoil(const std::string& name, const std::string& format) {
    if (name.starts_with("naca:")) return true;
    const std::string extension = std::filesystem::path(name).extension().string();
    return format.empty() && (extension == ".dat" || extension == ".txt" || extension == ".csv");
}

/// Returns the outlines of an airfoil as the markers of a mesh without cells.
Mesh mesh_of_outlines(const std::string& input) {
    Mesh mesh;
    const Geometry geometry = read_geometry(std::vector<std::string>{input});
    print_warnings_of_reader(geometry);
    for (const Element& element : geometry.elements) {
        const std::size_t first = mesh.points.size(), count = element.points.size();
        mesh.points.insert(mesh.points.end(), element.points.begin(), element.points.end());
        Marker wall{element.name, MarkerKind::wall, {}};
        // Edges of markers have the flow on their left, and outlines run counter-clockwise.
        for (std::size_t i = count; i-- > 0;)
            wall.edges.push_back({VertexId(first + (i + 1) % count), VertexId(first + i)});
        mesh.markers.push_back(std::move(wall));
    }
    return mesh;
}

void plot(const PlotArguments& arguments) {
    PlotOptions options;
    set_by_name(option_table<PlotOptions>(), "window", arguments.window, options);
    set_by_name(option_table<PlotOptions>(), "color", arguments.color, options);
    set_by_name(option_table<PlotOptions>(), "repeat", arguments.repeat, options);
    set_by_name(option_table<PlotOptions>(), "width", arguments.width, options);
    set_by_name(option_table<PlotOptions>(), "format", arguments.format, options);
    options.axes = arguments.axes;
    options.scale_bar = arguments.scale_bar;
    options.color_bar = arguments.color_bar;
    const std::vector<RunFile> outputs{{arguments.picture, "option --output"}};
    require_format(arguments.picture, arguments.format, "--format");
    if (names_airfoil(arguments.mesh, arguments.mesh_format)) {
        require_distinct(std::vector<RunFile>{{arguments.mesh, "MESH"}}, outputs);
        const SignalGuard guard(outputs);
        return plot_mesh(mesh_of_outlines(arguments.mesh), arguments.picture, options);
    }
    require_format(arguments.mesh, arguments.mesh_format, "--input-format");
    require_distinct(files_of_mesh(arguments.mesh, arguments.mesh_format), outputs);
    const SignalGuard guard(outputs);
    const CurvedMesh mesh = read_curved_mesh(arguments.mesh, {.format = arguments.mesh_format});
    plot_mesh(mesh.mesh, mesh.nodes, arguments.picture, options);
}

}  // namespace

void add_plot_command(CLI::App& app) {
    CLI::App* command = add_command(app, "plot", "draw a picture of a mesh, or of the outline of an airfoil");
    auto arguments = std::make_shared<PlotArguments>();
    add_option(*command, "MESH", arguments->mesh,
               "mesh file, or - for standard input; an airfoil where it is naca:DIGITS or ends in .dat, .txt or "
               ".csv")
        .required();
    add_input_format(*command, arguments->mesh_format);
    add_option(*command, "-o,--output", arguments->picture,
               "picture; its extension says the format: .png, .svg or .pdf; - for standard output")
        .required()
        .type_name("FILE");
    add_table_option(*command, option_table<PlotOptions>(), "window", arguments->window);
    add_table_option(*command, option_table<PlotOptions>(), "color", arguments->color);
    add_table_option(*command, option_table<PlotOptions>(), "repeat", arguments->repeat);
    add_table_flag(*command, option_table<PlotOptions>(), "axes", arguments->axes);
    add_table_flag(*command, option_table<PlotOptions>(), "scale-bar", arguments->scale_bar);
    add_table_flag(*command, option_table<PlotOptions>(), "color-bar", arguments->color_bar);
    add_table_option(*command, option_table<PlotOptions>(), "width", arguments->width);
    add_table_option(*command, option_table<PlotOptions>(), "format", arguments->format);
    run_with(*command, [arguments] { plot(*arguments); });
}

}  // namespace lamina::app
