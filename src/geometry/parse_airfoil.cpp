#include "geometry/parse_airfoil.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "geometry/coordinate_blocks.hpp"
#include "geometry/half_section.hpp"
#include "geometry/other_formats.hpp"
#include "geometry/outline_repair.hpp"

namespace lamina::geometry {

namespace {

std::vector<RawOutline> outlines_of_text(std::string_view text, const std::string& file, bool keep_open) {
    if (std::optional<std::vector<RawOutline>> outlines = read_drawing(text, file, keep_open))
        return *std::move(outlines);
    try {
        std::optional<CoordinateDocument> document = read_gmsh_points(text, file);
        if (!document) document = read_plot3d(text);
        if (!document) document = read_blocks(text, file);
        return assemble_outlines(std::move(*document), file, keep_open);
    } catch (const InputError&) {
        refuse_unread_drawings(text, file);
        throw;
    }
}

}  // namespace

std::vector<RawOutline> read_outlines(std::string_view text, const std::string& file, const GeometryOptions& options) {
    const bool keep_open = options.close || options.mirror_half;
    std::vector<RawOutline> outlines = outlines_of_text(text, file, keep_open);
    if (options.mirror_half)
        for (RawOutline& outline : outlines) {
            outline.points = mirrored_half(std::move(outline.points), file);
            outline.notes.push_back(
                fmt::format("line {}: half of a symmetric section, mirrored", outline.points[0].line));
        }
    return outlines;
}

std::vector<Element> parse_airfoil(std::string_view text, const std::string& file, const GeometryOptions& options) {
    std::vector<Element> elements;
    for (const RawOutline& outline : read_outlines(text, file, options))
        elements.push_back(repair_outline(outline, file, options));
    return elements;
}

}  // namespace lamina::geometry
