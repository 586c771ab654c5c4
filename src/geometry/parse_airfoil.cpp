#include "geometry/parse_airfoil.hpp"

#include "geometry/coordinate_rows.hpp"
#include "geometry/outline_repair.hpp"
#include "geometry/outlines.hpp"

namespace lamina::geometry {

std::vector<Element> parse_airfoil(std::string_view text, const std::string& file) {
    std::vector<Element> elements;
    for (const RawOutline& outline : assemble_outlines(read_rows(text, file), file))
        elements.push_back(repair_outline(outline, file));
    return elements;
}

}  // namespace lamina::geometry
