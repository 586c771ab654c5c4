// The edges of closed polygons in one list, with the indices of their neighbours.
#include "layers/polygon_edges.hpp"

namespace lamina::layers {

std::vector<PolygonEdge> polygon_edges(std::span<const std::vector<Point>> polygons,
                                       std::span<const std::vector<double>> target_factors) {
    std::vector<PolygonEdge> edges;
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        const std::vector<Point>& polygon = polygons[p];
        const std::size_t first = edges.size(), n = polygon.size();
        for (std::size_t k = 0; k < n; ++k) {
            const Point a = polygon[k], b = polygon[(k + 1) % n];
            edges.push_back({a, b, distance(a, b), first + (k + n - 1) % n, first + (k + 1) % n});
            if (!target_factors.empty()) edges.back().target_factor = target_factors[p][k];
        }
    }
    return edges;
}

}  // namespace lamina::layers
