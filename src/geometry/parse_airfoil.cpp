#include "geometry/parse_airfoil.hpp"

#include <utility>

#include "geometry/coordinate_rows.hpp"
#include "geometry/element_names.hpp"
#include "geometry/orientation_warnings.hpp"
#include "geometry/outline_repair.hpp"
#include "geometry/outlines.hpp"

namespace lamina::geometry {

std::vector<Element> parse_airfoil(std::string_view text, const std::string& file) {
    std::vector<Element> elements;
    for (const RawOutline& outline : assemble_outlines(read_rows(text, file), file))
        elements.push_back(repair_outline(outline, file));
    return elements;
}

Geometry make_geometry(std::vector<Element> elements, const GeometryOptions& options) {
    Geometry geometry{std::move(elements)};
    name_elements(geometry.elements, options);
    if (options.flip) geometry = flipped(std::move(geometry));
    geometry = transformed(std::move(geometry), options.transformations);
    check_simple(geometry);
    add_orientation_warnings(geometry, options.flip);
    return geometry;
}

}  // namespace lamina::geometry
