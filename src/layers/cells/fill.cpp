// Stage "fill the layer": the points of the layer are joined to cells.
#include "layers/cells/fill.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <set>
#include <span>
#include <utility>

#include <lamina/delaunay.hpp>

#include "core/parallel.hpp"
#include "core/predicates.hpp"
#include "core/rounding.hpp"
#include "layers/cells/polygon_cutter.hpp"

namespace lamina::layers {

// Between two neighbouring rays, the grid of rays and layers is a column of cells. The pictures show columns of rays of
// two origins, of rays of one origin, and of rays of which one has a layer more; the body lies below:
//
//     c---q2---q1---b   <- outer border      c-----b             b      b, c   the ends of the top; b on the first ray
//     |             |                        |     |         .-' |
//     |-------------|                         |---|         c----|      a, d   lower corners of a cell
//     |             |                         |   |         |    |
//     |-------------|                          |-|          |----|      q      division points of the border
//     |             |                          \ /          |    |
//     d-------------a   <- wall                a=d          d----a
//
// Source: the layer's rays are those of the thesis, chapter 3; joining them as a grid goes beyond it
// (docs/decisions/0012).

namespace {

constexpr std::size_t columns_per_block = 512;

/// Makes the cells of columns, one after the other.
class Connector {
public:
    Connector(const Layer& layer, GridCells form) : layer_(layer), form_(form), cutter_(layer.points) {}

    /// Adds the cells of a column.
    void add(const CellColumn& column) {
        const Ray &first = column.first, &second = column.second;
        const Point from = at(first.origin), to = at(second.origin);
        first_leads_ = core::is_forward(from == to ? second.direction - first.direction : to - from);
        const std::uint32_t common = std::min(first.layers, second.layers);
        const std::uint32_t highest = std::max(first.layers, second.layers);
        assert(highest - common <= 1);
        if (common == 0 && from == to) return;  // the border runs along the ray

        const bool divided_sides = column.up.size() > 2 || column.down.size() > 2;
        for (std::uint32_t n = 1; n <= highest; ++n) {
            const std::size_t first_triangle = cells_.triangles.size();
            const std::array<VertexId, 2> lower{first.vertex(n - 1), second.vertex(n - 1)};
            std::array<VertexId, 2> inner;
            std::span<const VertexId> top = column.top;
            if (n < highest) {
                inner = {first.vertex(n), second.vertex(n)};
                top = inner;
            }
            if (n == 1 && !first.corner_after.empty()) {
                add_cell_at_corner(column, top);
            } else if (n == 1 && divided_sides) {
                add_cell_between_borders(column, top);
            } else if (n == common && highest > common && column.top.size() > 2) {
                add_divided_step(column, common);
                n = highest;
            } else if (n > common) {
                add_polygon(std::span(lower).subspan(first.layers > common ? 0 : 1, 1), top);
            } else {
                add_cell(lower, top, n);
            }
            number_triangles(first_triangle, n);
        }
    }

    /// Adds the cells of the space behind a base, between successive chains.
    void add(const LayerCore& core) {
        first_leads_ = true;
        for (std::size_t c = 1; c < core.chains.size(); ++c) {
            const std::vector<VertexId>&lower = core.chains[c - 1], &upper = core.chains[c];
            const auto layer = static_cast<std::uint16_t>(c);
            const std::size_t n = lower.size();
            if (n != upper.size()) {
                add_polygon(lower, upper);
            } else {
                const bool first_joins = lower.front() == upper.front(), last_joins = lower.back() == upper.back();
                const std::size_t apart = n - first_joins - last_joins;
                if (first_joins) cells_.triangles.push_back({{lower[0], upper[1], lower[1]}});
                add_cells_between(std::span(lower).subspan(first_joins, apart),
                                  std::span(upper).subspan(first_joins, apart), layer);
                if (last_joins) cells_.triangles.push_back({{lower[n - 2], upper[n - 2], lower[n - 1]}});
            }
            cells_.triangle_layer.resize(cells_.triangles.size(), layer);
        }
    }

    /// Adds the triangles between the fronts on both sides of a cleft.
    void add(const LayerCleft& cleft) {
        first_leads_ = true;
        const std::vector<Ray>& rays = layer_.rays[cleft.element];
        corners_.clear();
        for (std::size_t i = cleft.last + 1; i-- > cleft.first;) corners_.push_back(rays[i].tip());
        corners_.insert(corners_.end(), cleft.outer_edge.begin() + 1, cleft.outer_edge.end() - 1);
        std::uint32_t most_layers = 0;
        for (std::size_t i = cleft.first; i <= cleft.last; ++i) most_layers = std::max(most_layers, rays[i].layers);
        cut_corners();
        number_triangles(0, most_layers);
    }

    /// Says that the cells added since the last call are part of the column with this number.
    void number_column(std::uint32_t number) {
        assert(cells_.triangle_layer.size() == cells_.triangles.size());
        assert(cells_.quad_layer.size() == cells_.quads.size());
        cells_.triangle_column.resize(cells_.triangles.size(), number);
        cells_.quad_column.resize(cells_.quads.size(), number);
    }

    LayerCells take() { return std::move(cells_); }

private:
    const Layer& layer_;
    GridCells form_;
    LayerCells cells_;
    PolygonCutter cutter_;
    bool first_leads_ = false;       ///< whether the first ray's corner has the preference where cuts are equal
    std::vector<VertexId> corners_;  ///< of a polygon; kept between calls for its memory

    Point at(VertexId v) const { return layer_.points[v.index()]; }

    /// Sets the layer of the triangles from `first` on, which were made for layer `n`. A triangle belongs to the layer
    /// above its lowest corner, but to none above n: all its corners may be at the height of a divided top.
    void number_triangles(std::size_t first, std::uint32_t n) {
        const auto above = [&](VertexId v) { return std::uint32_t{layer_.layer_of_point[v.index()]} + 1; };
        for (std::size_t t = first; t < cells_.triangles.size(); ++t) {
            const auto& [a, b, c] = cells_.triangles[t].v;
            cells_.triangle_layer.push_back(static_cast<std::uint16_t>(std::min({n, above(a), above(b), above(c)})));
        }
    }

    /// Adds the cells of layer n between two chains of equal length.
    void add_cells_between(std::span<const VertexId> lower, std::span<const VertexId> upper, std::uint16_t n) {
        for (std::size_t i = 0; i + 1 < lower.size(); ++i) add_cell({lower[i], lower[i + 1]}, upper.subspan(i, 2), n);
    }

    /// Adds the cell of layer n between two rays that both have it.
    void add_cell(const std::array<VertexId, 2>& lower, std::span<const VertexId> top, std::uint32_t n) {
        const auto [a, d] = lower;
        if (a == d) {
            add_polygon(std::span(lower).first(1), top);
        } else if (form_ == GridCells::whole && top.size() == 2 &&
                   core::is_convex(at(a), at(top[0]), at(top[1]), at(d))) {
            cells_.quads.push_back({{a, top[0], top[1], d}});
            cells_.quad_layer.push_back(static_cast<std::uint16_t>(n));
        } else {
            add_polygon(lower, top);
        }
    }

    /// Adds the triangles between two chains of vertices, which both run from the first ray to the second.
    void add_polygon(std::span<const VertexId> lower, std::span<const VertexId> upper) {
        corners_.assign(1, lower.front());
        append_corners(upper.begin(), upper.end());
        append_corners(lower.rbegin(), lower.rend() - 1);
        cut_corners();
    }

    /// Adds the triangle at the top of a column where one ray has a layer more, together with the cell below. Alone it
    /// could only be fanned from one corner, with ever flatter triangles.
    ///
    ///              .-b = q0
    ///          q1-'   |
    ///      q2-'       a'      a' is a corner of the polygon a, a', b, q1, q2, c, d; with the higher ray on the other
    ///    c-'          |       side, d' is
    ///    d------------a
    void add_divided_step(const CellColumn& column, std::uint32_t common) {
        const Ray &first = column.first, &second = column.second;
        corners_.assign(1, first.vertex(common - 1));
        if (first.layers > common) corners_.push_back(first.vertex(common));
        append_corners(column.top.begin(), column.top.end());
        if (second.layers > common) corners_.push_back(second.vertex(common));
        corners_.push_back(second.vertex(common - 1));
        cut_corners();
    }

    /// Adds the cells of the first layer in a sharp corner of the wall that has no ray. The triangles on the edges of
    /// the wall beside both rays have the first height, and that at the corner has its angle (docs/layer.md).
    /// Where no first layer fits between its sides, more of the wall's vertices have no rays, and triangles go from
    /// side to side.
    ///
    ///     d____        wall d e a; without the first layer on one of the rays, its origin is the end of the top
    ///     |    \___ c
    ///     e--.     |
    ///         `--. b
    ///             a
    void add_cell_at_corner(const CellColumn& column, std::span<const VertexId> top) {
        const std::vector<VertexId>& corner = column.first.corner_after;
        const VertexId a = column.second.origin, d = column.first.origin;
        if (d != top.front()) cells_.triangles.push_back({{corner.front(), d, top.front()}});
        corners_.assign(top.begin(), top.end());
        append_corners(corner.rbegin(), corner.rend());
        cut_corners();
        if (a != top.back()) cells_.triangles.push_back({{corner.back(), top.back(), a}});
    }

    /// Adds the lowest cell of a column beside an empty one. The border divides its sides, too.
    ///
    ///     c---q---b
    ///      \     |         the first ray is the end of a fan whose other rays have no layers
    ///       \    q
    ///        \   |
    ///         d--a
    void add_cell_between_borders(const CellColumn& column, std::span<const VertexId> top) {
        corners_.assign(1, column.first.origin);
        append_corners(column.up.begin(), column.up.end());
        append_corners(top.begin(), top.end());
        append_corners(column.down.begin(), column.down.end());
        append_corners(&column.second.origin, &column.second.origin + 1);
        cut_corners();
    }

    /// Adds vertices to the corners of the polygon, each once.
    template <class Iterator>
    void append_corners(Iterator begin, Iterator end) {
        for (; begin != end; ++begin)
            if (corners_.back() != *begin) corners_.push_back(*begin);
    }

    /// Adds the triangles of the polygon corners_, which is counter-clockwise. Its first and last corner may be one.
    void cut_corners() {
        if (corners_.back() == corners_.front()) corners_.pop_back();
        if (!cutter_.cut(corners_, first_leads_, cells_.triangles)) cells_.grid_refused = true;
    }
};

/// Returns one list of the cells of all blocks, in the order of the blocks.
template <class Item>
std::vector<Item> joined(const std::vector<LayerCells>& blocks, std::vector<Item> LayerCells::*items) {
    std::vector<std::size_t> first{0};
    for (const LayerCells& block : blocks) first.push_back(first.back() + (block.*items).size());
    std::vector<Item> all(first.back());
    core::parallel_for(blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            std::copy((blocks[i].*items).begin(), (blocks[i].*items).end(),
                      all.begin() + static_cast<std::ptrdiff_t>(first[i]));
    });
    return all;
}

}  // namespace

LayerCells connect_layer(const Layer& layer, GridCells form) {
    std::vector<LayerCells> blocks;
    std::size_t first_ray = 0;  // of the element, among the rays of all
    for (std::size_t e = 0; e < layer.rays.size(); first_ray += layer.rays[e].size(), ++e) {
        if (layer.rays[e].empty()) continue;
        const CellColumns columns(layer, e);
        const auto connect = [&](std::size_t begin, std::size_t end) {
            Connector connector(layer, form);
            for (std::size_t i = begin; i < end; ++i) {
                connector.add(columns[i]);
                connector.number_column(static_cast<std::uint32_t>(first_ray + i));
            }
            return connector.take();
        };
        for (LayerCells& block : core::parallel_blocks(columns.size(), columns_per_block, connect))
            blocks.push_back(std::move(block));
    }
    const auto add_part = [&](const auto& part) {
        Connector connector(layer, form);
        connector.add(part);
        connector.number_column(LayerCells::no_column);
        blocks.push_back(connector.take());
    };
    for (const LayerCore& core : layer.cores) add_part(core);
    for (const LayerCleft& cleft : layer.clefts) add_part(cleft);
    LayerCells cells;
    cells.triangles = joined(blocks, &LayerCells::triangles);
    cells.quads = joined(blocks, &LayerCells::quads);
    cells.triangle_layer = joined(blocks, &LayerCells::triangle_layer);
    cells.quad_layer = joined(blocks, &LayerCells::quad_layer);
    cells.triangle_column = joined(blocks, &LayerCells::triangle_column);
    cells.quad_column = joined(blocks, &LayerCells::quad_column);
    cells.grid_refused =
        std::any_of(blocks.begin(), blocks.end(), [](const LayerCells& block) { return block.grid_refused; });
    return cells;
}

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
    CellColumn column{rays_[i], rays_[second], border_between_tips(i), {}, {}};
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

/// Returns the triangles as cells. The layer of a triangle is that of its highest point, but 1 at least: in a sharp
/// corner all its points may be on the wall.
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

/// Returns the triangles as triangulate_layer() does, but without regard to lines.
delaunay::pieces::PiecewiseTriangulation triangulate_without_lines(const Layer& layer,
                                                                   const DecompositionOptions& options,
                                                                   core::BusyTimes* times) {
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

/// Returns the edges of the rays along lines, but for those along which the border runs.
std::vector<Segment> edges_along_lines(const Layer& layer) {
    std::vector<Segment> edges;
    for (const std::vector<Ray>& rays : layer.rays)
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Ray& ray = rays[i];
            if (!ray.along_line || bare_side_of(rays, i)) continue;
            for (std::uint32_t n = 1; n <= ray.layers; ++n) edges.push_back({ray.vertex(n - 1), ray.vertex(n)});
        }
    return edges;
}

/// Returns whether all these edges are edges of triangles.
bool holds_edges(std::span<const Triangle> triangles, std::span<const Segment> edges) {
    if (edges.empty()) return true;
    std::set<std::pair<VertexId, VertexId>> missing;
    for (const Segment& edge : edges) missing.insert(std::minmax(edge.a, edge.b));
    for (const Triangle& t : triangles)
        for (int k = 0; k < 3; ++k) missing.erase(std::minmax(t.v[k], t.v[(k + 1) % 3]));
    return missing.empty();
}

}  // namespace

delaunay::pieces::PiecewiseTriangulation triangulate_layer(const Layer& layer, const DecompositionOptions& options,
                                                           core::BusyTimes* times) {
    if (layer.edges.region.empty()) return {};
    auto pieces = triangulate_without_lines(layer, options, times);
    const std::vector<Segment> lines = edges_along_lines(layer);
    if (holds_edges(pieces.triangles, lines)) return pieces;
    std::vector<Segment> segments = layer.edges.region;
    segments.insert(segments.end(), lines.begin(), lines.end());
    pieces.triangles = triangulate(layer.points, segments, {.keep = KeptRegion::left_of_segments}).triangles;
    pieces.first = {0, pieces.triangles.size()};
    return pieces;
}

LayerCells fill(const Layer& layer, LayerTopology topology, const DecompositionOptions& options,
                core::BusyTimes* times) {
    if (layer.edges.region.empty()) return {};
    bool grid_refused = false;
    if (topology != LayerTopology::delaunay) {
        const core::BusyTimes::Scope busy(times, delaunay::pieces::triangulating);
        LayerCells cells = connect_layer(layer, topology == LayerTopology::quads ? GridCells::whole : GridCells::split);
        cells.first_triangle = {0, cells.triangles.size()};
        if (!cells.grid_refused) return cells;
        grid_refused = true;
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
