// Stage "fill the layer": the points of the layer are joined to cells.
#include "layers/fill.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <lamina/error.hpp>

#include "layers/connect.hpp"

namespace lamina::layers {

namespace {

/// Returns, for each point, whether it is part of the layer. A wall vertex is not part of it where the rays
/// beside it have no layers.
std::vector<char> used_points(const Layer& layer) {
    std::vector<char> used(layer.points.size(), 1);
    for (const auto& wall : layer.walls)
        for (VertexId v : wall) used[v.index()] = 0;
    for (const Segment& s : layer.edges.region) used[s.a.index()] = used[s.b.index()] = 1;
    return used;
}

/// Returns the triangles as cells. The layer of a triangle is that of its highest point, but 1 at least: in a sharp corner
/// all its points may be on the wall.
LayerCells cells_of(const Layer& layer, std::vector<Triangle> triangles) {
    LayerCells cells;
    cells.triangle_layer.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        const auto layer_of = [&](int k) { return layer.layer_of_point[t.v[k].index()]; };
        cells.triangle_layer.push_back(std::max({layer_of(0), layer_of(1), layer_of(2), std::uint16_t{1}}));
    }
    cells.triangles = std::move(triangles);
    return cells;
}

}  // namespace

delaunay::pieces::PiecewiseTriangulation triangulate_layer(const Layer& layer, const DecompositionOptions& options,
                                                           core::BusyTimes* times) {
    if (layer.edges.region.empty()) return {};
    const std::vector<char> used = used_points(layer);
    if (std::find(used.begin(), used.end(), 0) == used.end())
        return delaunay::pieces::triangulate_in_pieces(layer.points, layer.edges.region, options, times);

    std::vector<Point> points;  // the used ones
    std::vector<VertexId> id_in_layer, id_in_points(layer.points.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        id_in_points[i] = VertexId{points.size()};
        points.push_back(layer.points[i]);
        id_in_layer.push_back(VertexId{i});
    }
    std::vector<Segment> region = layer.edges.region;
    for (Segment& s : region) s = {id_in_points[s.a.index()], id_in_points[s.b.index()]};
    auto pieces = delaunay::pieces::triangulate_in_pieces(points, region, options, times);
    for (Triangle& t : pieces.triangles)
        for (VertexId& v : t.v) v = id_in_layer[v.index()];
    return pieces;
}

LayerCells fill(const Layer& layer, LayerTopology topology, const DecompositionOptions& options,
                core::BusyTimes* times) {
    if (layer.edges.region.empty()) return {};
    bool grid_refused = false;
    if (topology != LayerTopology::delaunay) {
        const core::BusyTimes::Scope busy(times, delaunay::pieces::triangulating);
        try {
            LayerCells cells =
                connect_layer(layer, topology == LayerTopology::quads ? GridCells::whole : GridCells::split);
            cells.first_triangle = {0, cells.triangles.size()};
            return cells;
        } catch (const InputError&) {
            grid_refused = true;  // the corners of a cell are no polygon
        }
    }
    auto triangulation = triangulate_layer(layer, options, times);
    LayerCells cells = cells_of(layer, std::move(triangulation.triangles));
    cells.first_triangle = std::move(triangulation.first);
    cells.decomposition = triangulation.stats;
    cells.grid_refused = grid_refused;
    return cells;
}

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

LayerCells fill_layer(const Layer& layer, LayerTopology topology, const DecompositionOptions& options) {
    validate(options);
    return fill(layer, topology, options, nullptr);
}

}  // namespace lamina
