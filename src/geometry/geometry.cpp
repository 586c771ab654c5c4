#include <lamina/geometry.hpp>

namespace lamina {

Box bounding_box(const Geometry& geometry) {
    Box box;
    for (const Element& element : geometry.elements)
        for (Point p : element.points) box.include(p);
    return box;
}

Box reference_box(const Geometry& geometry) { return geometry.unturned_box.value_or(bounding_box(geometry)); }

}  // namespace lamina
