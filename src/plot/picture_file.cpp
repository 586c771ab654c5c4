#include "plot/picture_file.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <memory>
#include <ostream>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/plot.hpp>

#include "core/atomic_file.hpp"
#include "core/file_name.hpp"

namespace lamina::plot {

namespace fs = std::filesystem;

namespace {

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

cairo_status_t write_to_stream(void* stream, const unsigned char* bytes, unsigned length) {
    std::ostream& out = *static_cast<std::ostream*>(stream);
    out.write(reinterpret_cast<const char*>(bytes), length);
    return out ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

CairoSurface make_png(std::ostream&, double width, double height) {
    return {cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height)),
            cairo_surface_destroy};
}
CairoSurface make_svg(std::ostream& out, double width, double height) {
    return {cairo_svg_surface_create_for_stream(write_to_stream, &out, width, height), cairo_surface_destroy};
}
CairoSurface make_pdf(std::ostream& out, double width, double height) {
    return {cairo_pdf_surface_create_for_stream(write_to_stream, &out, width, height), cairo_surface_destroy};
}

struct PictureFormat {
    const char* extension;
    CairoSurface (*make)(std::ostream&, double, double);
    bool is_image;  ///< whether the file is written once all is drawn, not meanwhile
};

constexpr PictureFormat picture_formats[] = {
    {".png", make_png, true}, {".svg", make_svg, false}, {".pdf", make_pdf, false}};

/// Returns the format of this name, or the one that the extension of the file stands for where no name is given.
const PictureFormat& picture_format_of(const fs::path& file, const std::string& name) {
    const std::string extension = name.empty() ? core::extension_of(file) : "." + name;
    for (const PictureFormat& format : picture_formats)
        if (extension == format.extension) return format;
    if (is_standard_stream(file)) throw UsageError("'-' has no extension that tells the format: png, svg or pdf");
    throw UsageError(
        fmt::format("{}: pictures are written as .png, .svg or .pdf, not as '{}'", file.string(), extension));
}

}  // namespace

void write_picture(const fs::path& file, const std::string& format, double width, double height,
                   const std::function<void(cairo_surface_t*)>& draw) {
    const PictureFormat& picture = picture_format_of(file, format);
    check_folder_writable(file);
    core::write_stream_atomically(file, [&](std::ostream& out) {
        const CairoSurface surface = picture.make(out, width, height);
        draw(surface.get());
        cairo_status_t status = CAIRO_STATUS_SUCCESS;
        if (picture.is_image) status = cairo_surface_write_to_png_stream(surface.get(), write_to_stream, &out);
        cairo_surface_finish(surface.get());
        if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
        // A stream that failed tells its own reason.
        if (status != CAIRO_STATUS_SUCCESS && out)
            throw IoError(file.string(), fmt::format("cannot draw: {}", cairo_status_to_string(status)));
    });
}

}  // namespace lamina::plot

namespace lamina {

void check_picture_format(const std::filesystem::path& file, const std::string& format) {
    plot::picture_format_of(file, format);
}

}  // namespace lamina
