// Pictures of meshes, and charts.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The quantity that decides the colour of a cell.
enum class PlotColor {
    none,     ///< white; the layer has a tint
    quality,  ///< smallest angle
    size,     ///< square root of the area, on a logarithmic scale
    piece,    ///< the subdomain that made the cell
    layer,    ///< the number of the layer
};

/// The part of the plane that a picture shows.
struct PlotWindow {
    std::array<double, 4> box{};  ///< x0, x1, y0, y1 in units of the input, unless a place is named
    std::string place{};          ///< the name of a place (named_places()); "nose" stands for "nose:1"
};

/// Options of plot_mesh().
struct PlotOptions {
    PlotColor color = PlotColor::none;   ///< the quantity that the colours of the cells show
    std::optional<PlotWindow> window{};  ///< empty: the whole mesh
    int width_px = 1600;                 ///< longer side of the picture, in pixels
    bool axes = false;                   ///< whether numbers beside the picture tell coordinates
    bool scale_bar = false;              ///< whether a bar in the picture tells lengths
    bool color_bar = false;              ///< whether a bar in the picture explains colours that stand for numbers
    std::string format{};                ///< "png", "svg" or "pdf"; empty: by the extension of the file
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const PlotOptions& options);

/// Draws the mesh as .png, .svg or .pdf. Walls are red; where there are no cells, their vertices have dots. In .svg and
/// .pdf many cells that are smaller than a pixel are one image, so that files stay small. The file gets a temporary name
/// beside the target and is renamed; "-" is standard output. Throws IoError, UsageError for other formats and extensions
/// and for places that the mesh does not have, OptionError for options out of range.
LAMINA_EXPORT void plot_mesh(const Mesh& mesh, const std::filesystem::path& file, const PlotOptions& options = {});

/// Throws UsageError unless pictures can be written in the format of this name or, where no name is given, in the one
/// that the extension of the file stands for.
LAMINA_EXPORT void check_picture_format(const std::filesystem::path& file, const std::string& format = {});

/// A curve of a chart.
struct ChartCurve {
    std::string name;           ///< in the legend
    std::vector<Point> points;  ///< joined by straight lines in this order
};

/// Options of plot_chart().
struct ChartOptions {
    std::string x_label{};     ///< below the horizontal axis
    std::string y_label{};     ///< above the vertical axis
    bool y_downwards = false;  ///< whether the numbers of the vertical axis grow downwards
    /// Interval of y to show, beyond which curves are cut off; empty: all.
    std::optional<std::array<double, 2>> y_range{};
    int width_px = 1200;   ///< width of the picture, in pixels; its height is two thirds of that
    std::string format{};  ///< "png", "svg" or "pdf"; empty: by the extension of the file
};

/// Draws curves over axes with numbers, each in a colour of its own, as .png, .svg or .pdf. The file gets a temporary
/// name beside the target and is renamed; "-" is standard output. Throws IoError, UsageError for other formats and
/// extensions. Precondition: coordinates are finite, and there is at least one point.
LAMINA_EXPORT void plot_chart(std::span<const ChartCurve> curves, const std::filesystem::path& file,
                              const ChartOptions& options = {});

}  // namespace lamina
