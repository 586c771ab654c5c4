// The edges of closed polygons in one list, with the indices of their neighbours.
#include "layers/polygon_edges.hpp"

#include <algorithm>

namespace lamina::layers {

std::vector<PolygonEdge> polygon_edges(std::span<const std::vector<Point>> polygons,
                                       std::span<const std::vector<double>> least_requests) {
    std::vector<PolygonEdge> edges;
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        const std::vector<Point>& polygon = polygons[p];
        const std::size_t first = edges.size(), n = polygon.size();
        for (std::size_t k = 0; k < n; ++k) {
            const Point a = polygon[k], b = polygon[(k + 1) % n];
            const double length = distance(a, b);
            const double requested = least_requests.empty() ? length : std::max(length, least_requests[p][k]);
            edges.push_back({a, b, length, first + (k + n - 1) % n, first + (k + 1) % n, requested});
        }
    }
    return edges;
}

}  // namespace lamina::layers
