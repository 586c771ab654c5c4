// The work of references.hpp done by delaunator-cpp.
#include <vector>

#include <delaunator.hpp>

#include "references.hpp"

namespace lamina::bench {

Work delaunator_delaunay(std::span<const Point> points) {
    std::vector<double> coordinates;
    for (const Point p : points) coordinates.insert(coordinates.end(), {p.x, p.y});
    return [coordinates] { return delaunator::Delaunator(coordinates).triangles.size() / 3; };
}

}  // namespace lamina::bench
