// Picture files: PNG, SVG and PDF.
#pragma once

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <string>

namespace lamina::plot {

/// Writes the picture that `draw` makes on a surface of this size in pixels. The file gets a temporary name beside the
/// target and is renamed; "-" is standard output. Throws IoError, and what check_picture_format() throws.
void write_picture(const std::filesystem::path& file, const std::string& format, double width, double height,
                   const std::function<void(cairo_surface_t*)>& draw);

}  // namespace lamina::plot
