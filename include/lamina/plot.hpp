// Pictures of meshes.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>
#include <lamina/option.hpp>

namespace lamina {

/// What cells are coloured by.
enum class PlotColor {
    none,  ///< layers are tinted
    quality,
    size,
    piece,
    layer,
};

struct PlotOptions {
    PlotColor color = PlotColor::none;
    std::optional<std::array<double, 4>> window{};  ///< x0, x1, y0, y1; empty: the whole mesh
    int width_px = 1600;                            ///< of the longer side of the picture
};

LAMINA_EXPORT const OptionTable<PlotOptions>& plot_option_table();

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const PlotOptions& options);

/// Draws the mesh as .png, .svg or .pdf, by the extension of the file. Walls are red. Writes to a temporary name beside
/// the target and renames it. Throws IoError; UsageError for other extensions; OptionError for options out of range.
LAMINA_EXPORT void plot_mesh(const Mesh& mesh, const std::filesystem::path& file, const PlotOptions& options = {});

}  // namespace lamina
