// Stage "fill the layer": the points of the layer are joined to cells.
#include "layers/cells/fill.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "layers/cells/connect.hpp"

namespace lamina::layers {

// The outer border cut into the stretches between the tips of neighbouring rays.

CellColumns::CellColumns(const Layer& layer, std::size_t element)
    : rays_(layer.rays[element]), is_open_(layer.is_open(element)), border_(layer.borders[element]) {
    if (!is_open_) border_.push_back(border_.front());
    for (const LayerCleft& cleft : layer.clefts) {
        if (cleft.element != element) continue;
        assert(cleft.first <= cleft.corner && cleft.corner < cleft.last && cleft.last < rays_.size());
        const auto outer_edge = std::find(border_.begin(), border_.end(), cleft.outer_edge.front()) + 1;
        const auto inner_points = static_cast<std::ptrdiff_t>(cleft.outer_edge.size()) - 2;
        assert(std::equal(cleft.outer_edge.begin() + 1, cleft.outer_edge.end(), outer_edge));
        const auto at = border_.erase(outer_edge, outer_edge + inner_points);
        std::vector<VertexId> tips;
        for (std::size_t i = cleft.first + 1; i < cleft.last; ++i) tips.push_back(rays_[i].tip());
        border_.insert(at, tips.begin(), tips.end());
    }
    // The border visits the tips in the order of the rays; rays of one origin without layers have one tip.
    std::size_t at = 0;
    tip_.reserve(rays_.size() + 1);
    for (const Ray& ray : rays_) {
        while (border_[at] != ray.tip()) ++at;
        assert(at < border_.size());
        tip_.push_back(at);
    }
    tip_.push_back(border_.size() - 1);
}

CellColumn CellColumns::operator[](std::size_t i) const {
    const std::size_t n = rays_.size(), before = (i + n - 1) % n, second = (i + 1) % n, after = (i + 2) % n;
    CellColumn column{rays_[i], rays_[second], border_between_tips(i), {}, {}, rays_[before], rays_[after]};
    if (border_runs_along(before, i)) column.up = border_between_tips(before);
    if (border_runs_along(after, second)) column.down = border_between_tips(second);
    return column;
}

/// Returns the stretch of the border from the tip of ray i to that of the next one, both included.
std::span<const VertexId> CellColumns::border_between_tips(std::size_t i) const {
    return {border_.data() + tip_[i], border_.data() + tip_[i + 1] + 1};
}

/// Returns whether, of two neighbours with one origin, `bare` has no layers and `ray` has one. The border between their
/// tips then is the lowest piece of `ray`.
bool CellColumns::border_runs_along(std::size_t bare, std::size_t ray) const {
    return rays_[bare].layers == 0 && rays_[ray].layers == 1 && rays_[bare].origin == rays_[ray].origin;
}

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

LayerCells fill_layer(const Layer& layer, LayerTopology topology, const DecompositionOptions& options) {
    validate(options);
    return fill(layer, topology, options, nullptr);
}

}  // namespace lamina::layers
