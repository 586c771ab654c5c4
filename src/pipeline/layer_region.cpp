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

decomposition::PiecewiseTriangulation triangulate_layer(const Layer& layer, const LayerEdges& edges,
                                                        const DecompositionOptions& options, BusyTimes* times) {
    if (edges.region.empty()) return {};
    // Where the layer is truncated to nothing, wall vertices are no part of it.
    std::vector<char> used(layer.points.size(), 1);
    for (const auto& wall : layer.walls)
        for (VertexId v : wall) used[v.index()] = 0;
    for (const Segment& s : edges.region) used[s.a.index()] = used[s.b.index()] = 1;
    if (std::find(used.begin(), used.end(), 0) == used.end())
        return decomposition::triangulate_in_pieces(layer.points, edges.region, options, times);

    std::vector<Point> points;
    std::vector<VertexId> whole, part(layer.points.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        part[i] = VertexId{points.size()};
        points.push_back(layer.points[i]);
        whole.push_back(VertexId{i});
    }
    std::vector<Segment> region = edges.region;
    for (Segment& s : region) s = {part[s.a.index()], part[s.b.index()]};
    auto pieces = decomposition::triangulate_in_pieces(points, region, options, times);
    for (Triangle& t : pieces.triangles)
        for (VertexId& v : t.v) v = whole[v.index()];
    return pieces;
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

LayerFill fill_layer(const Layer& layer, const LayerEdges& edges, LayerTopology topology,
                     const DecompositionOptions& options, BusyTimes* times) {
    LayerFill fill;
    if (edges.region.empty()) return fill;
    if (topology == LayerTopology::delaunay) {
        auto triangulation = triangulate_layer(layer, edges, options, times);
        fill.cells = cells_of(layer, std::move(triangulation.triangles));
        fill.first_triangle = std::move(triangulation.first);
        fill.decomposition = triangulation.stats;
    } else {
        const BusyTimes::Scope busy(times, Work::layer_triangulation);
        fill.cells = connect_layer(layer, topology == LayerTopology::quads ? GridCells::whole : GridCells::split);
        fill.first_triangle = {0, fill.cells.triangles.size()};
    }
    return fill;
}

}  // namespace lamina
