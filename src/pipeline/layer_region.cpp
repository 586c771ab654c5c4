#include "pipeline/layer_region.hpp"

#include <algorithm>
#include <utility>

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

std::vector<Triangle> triangulate_layer(const Layer& layer, const LayerEdges& edges) {
    if (edges.region.empty()) return {};
    return constrained_delaunay(layer.points, edges.region, {.keep = Keep::left_of_segments}).triangles;
}

namespace {

/// Each triangle on the layer of its highest point.
LayerCells cells_of(const Layer& layer, std::vector<Triangle> triangles) {
    LayerCells cells;
    cells.triangle_layer.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        const auto layer_of = [&](int k) { return layer.layer_of_point[t.v[k].index()]; };
        cells.triangle_layer.push_back(std::max({layer_of(0), layer_of(1), layer_of(2)}));
    }
    cells.triangles = std::move(triangles);
    return cells;
}

}  // namespace

LayerCells fill_layer(const Layer& layer, const LayerEdges& edges, LayerTopology topology) {
    switch (topology) {
        case LayerTopology::delaunay:
            break;
        case LayerTopology::layered:
            return connect_layer(layer, GridCells::split);
        case LayerTopology::quads:
            return connect_layer(layer, GridCells::whole);
    }
    return cells_of(layer, triangulate_layer(layer, edges));
}

}  // namespace lamina
