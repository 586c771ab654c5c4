// Meshes to and from files, and pictures of them. The format follows from the extension.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include <lamina/mesh.hpp>

namespace lamina {

/// Formats by extension: .su2 (ASCII, 17 significant digits), .vtu (appended raw binary; cell data region, piece,
/// layer, marker names in field data). Writes to a temporary name beside the target and renames, so that a failure
/// leaves nothing half-written. `format` ("su2", "vtu") goes over the extension where it is not empty.
/// Throws IoError; UsageError for an unknown format or extension.
void write_mesh(const Mesh& mesh, const std::filesystem::path& file, const std::string& format = {});

/// Throws IoError where the file cannot be read, InputError (with the line, for text formats) where it is malformed.
Mesh read_mesh(const std::filesystem::path& file);

/// Throws UsageError now rather than after minutes of meshing if write_mesh knows no format of this name, IoError if
/// its folder does not exist or is not writable.
void check_writable(const std::filesystem::path& file, const std::string& format = {});

enum class PlotColor { none, quality, size, piece, layer };

struct PlotOptions {
    PlotColor color = PlotColor::none;
    /// x0, x1, y0, y1; empty = the whole mesh.
    std::optional<std::array<double, 4>> window{};
    int width_px = 1600;  ///< of the longer side of the picture
};

/// Draws the mesh as .png, .svg or .pdf (Cairo). Same promises and errors as write_mesh.
void plot_mesh(const Mesh& mesh, const std::filesystem::path& file, const PlotOptions& options = {});

}  // namespace lamina
