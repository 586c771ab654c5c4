// lamina plot: a picture of a mesh.
#include <array>
#include <memory>
#include <optional>
#include <string>

#include <lamina/io.hpp>

#include "app/commands.hpp"
#include "app/options.hpp"

namespace lamina::app {

namespace {

struct PlotArguments {
    std::string mesh;
    std::string picture;
    std::string window;
    std::string color = "none";
    int width_px = PlotOptions{}.width_px;
};

std::array<double, 4> parse_window(const std::string& text) {
    const std::string origin = "option --window";
    const std::vector<std::string> parts = CLI::detail::split(text, ',');
    if (parts.size() != 4) throw UsageError(origin + ": '" + text + "' is not x0,x1,y0,y1");
    std::array<double, 4> window{};
    for (std::size_t i = 0; i < window.size(); ++i) window[i] = parse_real(parts[i], origin);
    if (!(window[0] < window[1] && window[2] < window[3])) {
        throw UsageError(origin + ": x0 must be below x1, and y0 below y1");
    }
    return window;
}

PlotOptions plot_options(const PlotArguments& arguments) {
    static const Choices<PlotColor> colors{{"none", PlotColor::none},
                                           {"quality", PlotColor::quality},
                                           {"size", PlotColor::size},
                                           {"piece", PlotColor::piece},
                                           {"layer", PlotColor::layer}};
    PlotOptions options;
    options.color = choose(arguments.color, colors, "option --color");
    if (!arguments.window.empty()) options.window = parse_window(arguments.window);
    if (arguments.width_px < 16 || arguments.width_px > 32768) {
        throw UsageError("option --width: must be >= 16 and <= 32768 pixels");
    }
    options.width_px = arguments.width_px;
    return options;
}

}  // namespace

void add_plot_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("plot", "a picture of a mesh");
    auto arguments = std::make_shared<PlotArguments>();
    command->add_option("MESH", arguments->mesh, "mesh file")->required();
    command->add_option("-o,--output", arguments->picture, "picture: .png, .svg or .pdf")
        ->required()
        ->type_name("FILE");
    command->add_option("--window", arguments->window, "part of the plane to show; else all of the mesh")
        ->type_name("X0,X1,Y0,Y1");
    command->add_option("--color", arguments->color, "what cells are coloured by")
        ->type_name("none|quality|size|piece|layer")
        ->capture_default_str();
    command->add_option("--width", arguments->width_px, "longer side of the picture, in pixels")
        ->type_name("PX")
        ->capture_default_str();
    command->callback([arguments] {
        const PlotOptions options = plot_options(*arguments);
        plot_mesh(read_mesh(arguments->mesh), arguments->picture, options);
    });
}

}  // namespace lamina::app
