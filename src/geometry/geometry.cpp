#include <lamina/geometry.hpp>

#include "geometry/sheets.hpp"

namespace lamina {

Box bounding_box(const Geometry& geometry) {
    Box box;
    for (const Element& element : geometry.elements)
        for (Point p : element.points) box.include(p);
    return box;
}

Box reference_box(const Geometry& geometry) {
    if (geometry.unturned_box) return *geometry.unturned_box;
    // The second sides of sheets are left out, since the gap before them is no part of the configuration.
    Box box;
    for (const Element& element : geometry.elements) {
        const std::size_t n = element.points.size();
        std::vector<char> is_behind(n);
        for (const geometry::SheetRange& range : geometry::sheet_ranges(element))
            for (std::size_t i = range.tip + 1; i <= range.last; ++i)
                is_behind[i % n] = i % n != range.first % n ? 1 : 0;
        for (std::size_t i = 0; i < n; ++i)
            if (is_behind[i] == 0) box.include(element.points[i]);
    }
    return box;
}

}  // namespace lamina
