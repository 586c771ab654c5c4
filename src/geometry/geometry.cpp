#include <lamina/geometry.hpp>

namespace lamina {

Box bounding_box(const Geometry& geometry) {
    Box box;
    for (const Element& element : geometry.elements)
        for (Point p : element.points) box.include(p);
    return box;
}

}  // namespace lamina
