// Pictures of meshes.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>
#include <lamina/option.hpp>

namespace lamina {

/// The quantity that decides the colour of a cell.
enum class PlotColor {
    none,     ///< white; the layer has a tint
    quality,  ///< smallest angle
    size,     ///< square root of the area, on a logarithmic scale
    piece,    ///< the subdomain that made the cell
    layer,    ///< the number of the layer
};

/// Options of plot_mesh().
struct PlotOptions {
    PlotColor color = PlotColor::none;              ///< the quantity that the colours of the cells show
    std::optional<std::array<double, 4>> window{};  ///< x0, x1, y0, y1 in units of the input; empty: the whole mesh
    int width_px = 1600;                            ///< longer side of the picture, in pixels
    std::string format{};                           ///< "png", "svg" or "pdf"; empty: by the extension of the file
};

/// Returns the table of these options, with names, ranges and help.
LAMINA_EXPORT const OptionTable<PlotOptions>& plot_option_table();

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const PlotOptions& options);

/// Draws the mesh as .png, .svg or .pdf. Walls are red. The file gets a temporary name beside the target and is
/// renamed; "-" is standard output. Throws IoError, UsageError for other formats and extensions, OptionError for
/// options out of range.
LAMINA_EXPORT void plot_mesh(const Mesh& mesh, const std::filesystem::path& file, const PlotOptions& options = {});

}  // namespace lamina
