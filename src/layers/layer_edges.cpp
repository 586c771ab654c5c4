// The edges of walls and outer borders, sorted by what lies beside them.
#include <algorithm>

#include <lamina/layers.hpp>

namespace lamina {

LayerEdges layer_edges(const Layer& layer) {
    LayerEdges result;
    std::vector<Segment> wall_edges, border_edges;  // both counter-clockwise
    for (const auto& wall : layer.walls) {
        auto& clockwise = result.walls.emplace_back();
        for (std::size_t i = 0; i < wall.size(); ++i) {
            const VertexId a = wall[i], b = wall[i + 1 < wall.size() ? i + 1 : 0];
            wall_edges.push_back({a, b});
            clockwise.push_back({b, a});
        }
    }
    for (const auto& border : layer.borders)
        for (std::size_t i = 0; i < border.size(); ++i)
            border_edges.push_back({border[i], border[i + 1 < border.size() ? i + 1 : 0]});

    std::sort(wall_edges.begin(), wall_edges.end());
    std::sort(border_edges.begin(), border_edges.end());
    for (const Segment& e : border_edges) {
        if (std::binary_search(wall_edges.begin(), wall_edges.end(), e)) continue;
        result.region.push_back(e);
        result.interfaces.push_back({std::min(e.a, e.b), std::max(e.a, e.b)});
    }
    for (const Segment& e : wall_edges)
        if (!std::binary_search(border_edges.begin(), border_edges.end(), e)) result.region.push_back({e.b, e.a});
    std::sort(result.interfaces.begin(), result.interfaces.end());
    return result;
}

std::vector<std::vector<Point>> border_loops(const Layer& layer) {
    std::vector<std::vector<Point>> loops;
    for (const auto& border : layer.borders) {
        std::vector<Point>& loop = loops.emplace_back();
        loop.reserve(border.size());
        for (VertexId v : border) loop.push_back(layer.points[v.index()]);
    }
    return loops;
}

}  // namespace lamina
