// Pictures of meshes, and charts, as .png, .svg or .pdf.
//
// Guarantees:
//  1. The file gets a temporary name beside the target and is renamed; "-" is standard output.
//  2. In .svg and .pdf many cells that are smaller than a pixel are one image, so that files stay small.
//  3. IoError, UsageError for other formats and extensions, and OptionError for options out of range are thrown.
// Example:
//     const Mesh mesh = generate_mesh({"naca:0012:60"}, {.layer = {.enabled = false}}).mesh;
//     plot_mesh(mesh, "n.png", {.color = PlotColor::quality, .window = PlotWindow{.place = "nose"}, .width_px = 300});
//     assert(read_file("n.png").substr(1, 3) == "PNG");
#pragma once

#include <filesystem>

#include <lamina/curved_mesh.hpp>
#include <lamina/mesh.hpp>

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
    std::size_t repeat = 1;              ///< copies of a mesh with periodic borders to draw, joined to each other
    bool axes = false;                   ///< whether numbers beside the picture tell coordinates
    bool scale_bar = false;              ///< whether a bar in the picture tells lengths
    bool color_bar = false;              ///< whether a bar in the picture explains colours that stand for numbers
    std::string format{};                ///< "png", "svg" or "pdf"; empty: by the extension of the file
};

LAMINA_EXPORT void validate(const PlotOptions& options);  ///< throws OptionError: an option out of range
/// Draws the mesh: walls are red, with dots at vertices without cells. Throws UsageError for places unknown, too.
LAMINA_EXPORT void plot_mesh(const Mesh& mesh, const std::filesystem::path& file, const PlotOptions& options = {});
/// Draws a mesh with curved cells, once. Precondition: check_curved() finds no defect of the lists of nodes.
LAMINA_EXPORT void plot_mesh(const Mesh& mesh, const CurvedNodes& nodes, const std::filesystem::path& file,
                             const PlotOptions& options = {});
/// A number at each vertex of a mesh.
struct PlotField {
    std::string name;              ///< beside the bar of colours
    std::vector<double> values;    ///< per vertex
    std::optional<double> line{};  ///< the value along which a line is drawn
};
/// Draws a field, linear in triangles and in the halves of quads, and the boundary of the mesh, in place of the cells.
/// The colours span the numbers in view. Throws UsageError where the field does not fit the mesh.
LAMINA_EXPORT void plot_field(const Mesh& mesh, const PlotField& field, const std::filesystem::path& file,
                              const PlotOptions& options = {});
/// Throws UsageError for an unknown format or, where none is given, an unknown extension.
LAMINA_EXPORT void check_picture_format(const std::filesystem::path& file, const std::string& format = {});

/// A curve of a chart.
struct ChartCurve {
    std::string name;           ///< in the legend
    std::vector<Point> points;  ///< joined by straight lines in this order
};

/// Options of plot_chart().
struct ChartOptions {
    std::string x_label{};                           ///< below the horizontal axis
    std::string y_label{};                           ///< above the vertical axis
    bool y_downwards = false;                        ///< whether the numbers of the vertical axis grow downwards
    std::optional<std::array<double, 2>> y_range{};  ///< what to show of y, beyond which curves are cut off; empty: all
    int width_px = 1200;   ///< width of the picture, in pixels; its height is two thirds of that
    std::string format{};  ///< "png", "svg" or "pdf"; empty: by the extension of the file
};

/// Draws curves over axes, each in a colour of its own. Precondition: there is a point, and coordinates are finite.
LAMINA_EXPORT void plot_chart(std::span<const ChartCurve> curves, const std::filesystem::path& file,
                              const ChartOptions& options = {});

}  // namespace lamina
