// Stage "close the border": the fronts are divided, and all points of the layer placed. Source: J. K. Pardue, thesis
// (2015), chapter 3.
#include "layers/border/close_border.hpp"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <optional>
#include <utility>

#include <lamina/layers.hpp>

#include "core/parallel.hpp"
#include "layers/border/divide_borders.hpp"
#include "layers/layer.hpp"
#include "layers/layered_rays.hpp"
#include "layers/measures.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

// The numbering and placing of the points of the layer: walls, rays, borders.

namespace {

class LayerBuilder {
public:
    LayerBuilder(const Rays& rays, const std::vector<std::vector<FrontCorner>>& corners, const BorderDivision& division)
        : rays_(rays),
          set_(rays.set),
          corners_(corners),
          division_(division),
          origin_of_ray_(set_.lines.size()),
          corner_after_ray_(set_.lines.size()),
          first_point_(set_.lines.size()),
          base_of_element_(set_.elements()),
          wall_divisions_(corners.size()) {}

    Layer build() && {
        place_walls();
        place_wakes();
        place_cores();
        place_ray_points();
        place_borders();
        if (rays_.enabled) {
            describe_rays();
        } else {
            layer_.rays.resize(set_.elements());
        }
        for (auto* lists : {&layer_.walls, &layer_.borders}) lists->resize(rays_.shown());
        layer_.rays.resize(rays_.shown());
        assert(layer_.layer_of_point.size() == layer_.points.size());
        return std::move(layer_);
    }

private:
    const Rays& rays_;
    const RaySet& set_;
    const std::vector<std::vector<FrontCorner>>& corners_;
    const BorderDivision& division_;
    std::vector<VertexId> origin_of_ray_;                  ///< the origin of each ray
    std::vector<std::vector<VertexId>> corner_after_ray_;  ///< RayLine::corner_after of each ray
    std::vector<std::size_t> first_point_;                 ///< Ray::first_point of each ray
    std::vector<std::vector<VertexId>> base_of_element_;   ///< with its corners; empty without a wake behind it
    /// For each corner of each front, the division points of the wall edge behind it.
    std::vector<std::vector<std::vector<VertexId>>> wall_divisions_;
    Layer layer_;

    VertexId add_point(Point p, std::uint32_t layer) {
        layer_.points.push_back(p);
        layer_.layer_of_point.push_back(static_cast<std::uint16_t>(layer));
        return VertexId(layer_.points.size() - 1);
    }

    /// Returns the number of edges of a front in the domain.
    std::size_t edges_in_domain(std::size_t element) const {
        const std::size_t corners = corners_in_domain(rays_, element, corners_[element]);
        return corners > 0 ? corners - rays_.is_open(element) : 0;
    }

    const FrontCorner& corner_after(std::size_t element, std::size_t k) const {
        return corners_[element][(k + 1) % corners_[element].size()];
    }

    /// Adds the vertices of a base before a wake, where no rays stand, to the end of the wall that begins and ends at
    /// its corners. That on a line of symmetry, where the wall of half a body begins, comes before the wall.
    void place_base(const WakeCore& core) {
        std::vector<VertexId>& wall = layer_.walls[core.element];
        const std::vector<Point>& base = core.chains.front();
        std::vector<VertexId>& placed = base_of_element_[core.element];
        const bool is_half = rays_.is_open(core.element);
        if (!is_half) placed.push_back(wall.back());
        for (std::size_t i = is_half ? 0 : 1; i + 1 < base.size(); ++i) placed.push_back(add_point(base[i], 0));
        const auto first = placed.begin() + !is_half;
        wall.insert(is_half ? wall.begin() : wall.end(), first, placed.end());
        placed.push_back(is_half ? wall[placed.size()] : wall.front());
    }

    /// Adds the division points of the edge behind a corner of a front to the end of the wall, if that edge is the
    /// wall's.
    void divide_wall(std::size_t element, std::size_t k) {
        if (corners_[element][k].layers > 0 || corner_after(element, k).layers > 0) return;
        std::vector<VertexId>& divisions = wall_divisions_[element][k];
        for (Point p : division_.points[element][k]) divisions.push_back(add_point(p, 0));
        layer_.walls[element].insert(layer_.walls[element].end(), divisions.begin(), divisions.end());
    }

    /// Places the origin of a ray at the end of the wall so far, unless it is there.
    void place_origin(std::size_t ray, std::vector<VertexId>& wall) {
        const auto is_at = [&](VertexId v) { return set_.lines[ray].origin == layer_.points[v.index()]; };
        if (!wall.empty() && is_at(wall.back())) {
            origin_of_ray_[ray] = wall.back();
        } else if (!wall.empty() && is_at(wall.front())) {
            // A wall with a wake ends at the sharp trailing edge that it begins at.
            origin_of_ray_[ray] = wall.front();
        } else {
            origin_of_ray_[ray] = add_point(set_.lines[ray].origin, 0);
            wall.push_back(origin_of_ray_[ray]);
        }
    }

    /// Places the walls. Division points of the border divide the wall, too, where the border runs along it.
    void place_walls() {
        layer_.walls.resize(set_.elements());
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            std::vector<VertexId>& wall = layer_.walls[e];
            wall_divisions_[e].resize(corners_[e].size());
            const std::size_t edges = edges_in_domain(e);
            std::size_t k = 0;  // the next corner of the front
            for (std::size_t i = set_.begin[e]; i < rays_.domain_end(e); ++i) {
                if (set_.lines[i].place == RayPlace::wall) place_origin(i, wall);
                const auto divide_edge_behind = [&](std::size_t after) {
                    if (k < edges && corners_[e][k].ray == i && corners_[e][k].after == after) divide_wall(e, k++);
                };
                divide_edge_behind(0);
                for (const Point p : set_.lines[i].corner_after) {
                    corner_after_ray_[i].push_back(add_point(p, 0));
                    wall.push_back(corner_after_ray_[i].back());
                    divide_edge_behind(corner_after_ray_[i].size());
                }
            }
            assert(k == edges);
            for (const WakeCore& core : rays_.cores)
                if (core.element == e) place_base(core);
        }
        layer_.wall_points = layer_.points.size();
    }

    /// Places the vertices of wakes. Where both sides have one vertex, that on the way back is that of the way out.
    void place_wakes() {
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            std::vector<VertexId> way_out;
            bool ended = false;
            for (std::size_t i = set_.begin[e]; i < rays_.domain_end(e); ++i) {
                const RayLine& ray = set_.lines[i];
                if (ray.place == RayPlace::wall) continue;
                const bool has_way_out = ended && !way_out.empty();  // a wake along a line of symmetry has none
                const bool shared = has_way_out && ray.origin == layer_.points[way_out.back().index()];
                origin_of_ray_[i] = shared ? way_out.back() : add_point(ray.origin, 0);
                if (has_way_out) {
                    way_out.pop_back();
                } else if (!ended) {
                    ended = ray.place == RayPlace::wake_end;
                    if (!ended) way_out.push_back(origin_of_ray_[i]);
                }
            }
        }
    }

    /// Returns the first ray of the way out along the wake of an element, and the last one of the way back: the latter
    /// twice where half of it is above a line of symmetry.
    std::pair<std::size_t, std::size_t> ends_of_wake(std::size_t element) const {
        const auto on_wall = [&](std::size_t ray) { return set_.lines[ray].place == RayPlace::wall; };
        if (rays_.is_open(element)) {
            std::size_t back = set_.begin[element];
            while (!on_wall(back + 1)) ++back;
            return {back, back};
        }
        const std::size_t back = set_.begin[element + 1] - 1;
        std::size_t out = back;
        while (!on_wall(out - 1)) --out;
        return {out, back};
    }

    /// Places the inner points of cores, and gathers those that have vertices already: on the base and at stations.
    void place_cores() {
        for (const WakeCore& core : rays_.cores) {
            LayerCore& placed =
                layer_.cores.emplace_back(LayerCore{core.element, {base_of_element_[core.element]}, core.stations});
            placed.chains.resize(core.chains.size());
            // Vertex k of the wake is the origin of ray out + k and of ray back - k; of the latter alone where half of
            // it is above a line of symmetry, on which chains begin then.
            const bool is_half = rays_.is_open(core.element);
            const auto [out, back] = ends_of_wake(core.element);
            std::size_t k = 0;
            for (std::size_t c = 1; c < core.chains.size(); ++c) {
                const bool station = core.stations[k] == c;
                std::vector<VertexId>& chain = placed.chains[c];
                for (std::size_t i = 0; i < core.chains[c].size(); ++i) {
                    const bool last = i + 1 == core.chains[c].size(), first = i == 0 && !(is_half && last);
                    const std::vector<VertexId>& before = placed.chains[c - 1];
                    if (!last && (!first || is_half))
                        chain.push_back(add_point(core.chains[c][i], c));
                    else if (station)
                        chain.push_back(origin_of_ray_[first ? out + k : back - k]);
                    else
                        chain.push_back(first ? before.front() : before.back());
                }
                assert(chain.size() == core.chains[c].size());
                k += station;
            }
        }
    }

    void place_ray_points() {
        std::size_t total = layer_.points.size();
        std::vector<std::uint32_t> counts = rays_.counts;
        for (std::size_t e = 0; e < set_.elements(); ++e)
            for (std::size_t i = set_.begin[e]; i < set_.begin[e + 1]; ++i) {
                if (i >= rays_.domain_end(e)) counts[i] = 0;
                first_point_[i] = total;
                total += counts[i];
            }
        layer_.points.resize(total);
        layer_.layer_of_point.resize(total);
        core::parallel_for(set_.lines.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::span<const double> heights = rays_.heights.of(i);
                for (std::uint32_t n = 1; n <= counts[i]; ++n) {
                    layer_.points[first_point_[i] + n - 1] = set_.lines[i].at(heights[n]);
                    layer_.layer_of_point[first_point_[i] + n - 1] = static_cast<std::uint16_t>(n);
                }
            }
        });
    }

    void place_borders() {
        layer_.borders.resize(set_.elements());
        layer_.outer_walls = rays_.outer_walls;
        for (std::size_t e = 0; e < rays_.shown(); ++e) layer_.open.push_back(rays_.is_open(e));
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            std::vector<VertexId>& border = layer_.borders[e];
            const std::size_t corners = corners_in_domain(rays_, e, corners_[e]), edges = edges_in_domain(e);
            for (std::size_t k = 0; k < corners; ++k) {
                const FrontCorner &corner = corners_[e][k], &after = corner_after(e, k);
                const std::size_t first = border.size();
                border.push_back(vertex_at(corner));
                if (k == edges) break;
                if (corner.layers == 0 && after.layers == 0) {
                    border.insert(border.end(), wall_divisions_[e][k].begin(), wall_divisions_[e][k].end());
                } else {
                    for (Point p : division_.points[e][k])
                        border.push_back(add_point(p, std::min(corner.layers, after.layers)));
                }
                if (!corner.cleft) continue;
                const CleftEnd& end = *corner.cleft;
                const std::size_t begin = set_.begin[e];
                LayerCleft& cleft =
                    layer_.clefts.emplace_back(LayerCleft{e, end.corner - begin, end.first - begin, end.last - begin});
                cleft.outer_edge.assign(border.begin() + static_cast<std::ptrdiff_t>(first), border.end());
                cleft.outer_edge.push_back(vertex_at(after));
            }
        }
    }

    /// Returns the vertex of a front's corner.
    VertexId vertex_at(const FrontCorner& corner) const {
        assert(corner.layers <= rays_.counts[corner.ray]);
        if (corner.after > 0) return corner_after_ray_[corner.ray][corner.after - 1];
        return corner.layers == 0 ? origin_of_ray_[corner.ray] : VertexId(first_point_[corner.ray] + corner.layers - 1);
    }

    /// Returns the height that a ray's points stay below because something is in its way. A ray that was lowered for
    /// its neighbours' sake ends below the layer that it did not get.
    double height_limit(std::size_t ray) const {
        const HeightColumn& column = rays_.heights.column(ray);
        if (rays_.counts[ray] < column.layers) return rays_.heights.of(ray)[rays_.counts[ray] + 1];
        const bool has_lost_layers = rays_.growth.layers && column.stretch.factor != 1;
        return column.cut || has_lost_layers ? rays_.front[ray] : HUGE_VAL;
    }

    void describe_rays() {
        layer_.rays.resize(set_.elements());
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            for (std::size_t i = set_.begin[e]; i < rays_.domain_end(e); ++i) {
                const HeightColumn& column = rays_.heights.column(i);
                const std::uint32_t count = rays_.counts[i];
                layer_.rays[e].push_back({.origin = origin_of_ray_[i],
                                          .direction = set_.lines[i].direction,
                                          .layers = count,
                                          .requested = column.asked_layers,
                                          .growth = column.growth,
                                          .first_point = first_point_[i],
                                          .height_limit = height_limit(i),
                                          .place = set_.lines[i].place,
                                          .along_line = set_.lines[i].line_room > 0,
                                          .corner_after = corner_after_ray_[i]});
            }
        }
    }
};

}  // namespace

Layer build_layer(const Rays& rays, const std::vector<std::vector<FrontCorner>>& corners,
                  const BorderDivision& division) {
    return LayerBuilder(rays, corners, division).build();
}

// The corners of fronts, and the fronts as points.

/// Adds the corners of a front at a ray and at the corners of the wall behind it. `ends` tells the last ray of the
/// domain.
void add_corners(const Rays& rays, std::size_t i, std::size_t next, bool ends, std::vector<FrontCorner>& front) {
    const RayLine &ray = rays.set.lines[i], &behind = rays.set.lines[next];
    const bool on_wall = rays.counts[i] == 0 && rays.counts[next] == 0;
    if (!on_wall || ray.origin != behind.origin || ends) front.push_back({i, rays.counts[i]});
    if (!on_wall) return;
    for (std::size_t k = 1; k <= ray.corner_after.size(); ++k) front.push_back({i, 0, k});
}

/// Adds the corners of the front of an outer wall. Rays at one vertex have one corner there if they have no layers.
void add_outer_corners(const Rays& rays, std::size_t element, std::vector<FrontCorner>& front) {
    const RaySet& set = rays.set;
    const std::size_t shown = rays.domain_end(element);
    for (std::size_t i = set.begin[element]; i < set.begin[element + 1]; ++i) {
        const bool goes_on = i + 1 < shown && set.lines[i].origin == set.lines[i + 1].origin;
        if (goes_on && rays.counts[i] == 0 && rays.counts[i + 1] == 0) continue;
        front.push_back({i, i < shown ? rays.counts[i] : 0});
    }
}

std::vector<std::vector<FrontCorner>> front_corners(const Rays& rays) {
    const RaySet& set = rays.set;
    const std::vector<std::uint32_t>& counts = rays.counts;
    std::vector<std::vector<FrontCorner>> fronts(set.elements());
    const std::vector<CleftEnd> clefts = cleft_ends(layered_rays(rays));
    std::size_t cleft = 0;  // the next one
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t begin = set.begin[e], end = set.begin[e + 1];
        if (rays.is_outer(e)) {
            add_outer_corners(rays, e, fronts[e]);
            continue;
        }
        for (std::size_t i = begin; i < end; ++i) {
            if (cleft < clefts.size() && i == clefts[cleft].first) {
                fronts[e].push_back({i, counts[i], 0, clefts[cleft]});
                i = clefts[cleft++].last - 1;
            } else {
                add_corners(rays, i, i + 1 < end ? i + 1 : begin, i + 1 == rays.domain_end(e), fronts[e]);
            }
        }
    }
    return fronts;
}

std::size_t corners_in_domain(const Rays& rays, std::size_t element, std::span<const FrontCorner> corners) {
    const auto hidden = std::find_if(corners.begin(), corners.end(),
                                     [&](const FrontCorner& corner) { return corner.ray >= rays.domain_end(element); });
    return static_cast<std::size_t>(hidden - corners.begin());
}

Point place_of(const LayeredRays& rays, const FrontCorner& corner) {
    return corner.after > 0 ? rays.set.lines[corner.ray].corner_after[corner.after - 1]
                            : rays.point(corner.ray, corner.layers);
}

std::vector<std::vector<Point>> fronts(const Rays& rays) {
    const LayeredRays layered = layered_rays(rays);
    std::vector<std::vector<Point>> result;
    for (const std::vector<FrontCorner>& corners : front_corners(rays)) {
        std::vector<Point>& front = result.emplace_back();
        front.reserve(corners.size());
        for (const FrontCorner& corner : corners) front.push_back(place_of(layered, corner));
    }
    return result;
}

// The edges of walls and outer borders, sorted by what lies beside them.

/// Returns the edges of chains, each closed unless the layer of its element is open.
std::vector<std::vector<Segment>> edges_of(const std::vector<std::vector<VertexId>>& chains, const Layer& layer) {
    std::vector<std::vector<Segment>> edges(chains.size());
    for (std::size_t e = 0; e < chains.size(); ++e)
        for (std::size_t i = 0; i + layer.is_open(e) < chains[e].size(); ++i)
            edges[e].push_back({chains[e][i], chains[e][i + 1 < chains[e].size() ? i + 1 : 0]});
    return edges;
}

std::vector<Segment> sorted_together(const std::vector<std::vector<Segment>>& edges) {
    std::vector<Segment> together;
    for (const std::vector<Segment>& of_element : edges)
        together.insert(together.end(), of_element.begin(), of_element.end());
    std::sort(together.begin(), together.end());
    return together;
}

/// Adds the edges of a wake along a line of symmetry, and of the space behind a base before it, on that line.
void add_wake_on_symmetry(const Layer& layer, std::size_t element, std::vector<Segment>& edges) {
    const std::vector<Ray>& rays = layer.rays[element];
    std::vector<VertexId> line;  // from the trailing edge to the end of the wake
    for (const LayerCore& core : layer.cores)
        if (core.element == element)
            for (const std::vector<VertexId>& chain : core.chains) line.push_back(chain.front());
    const auto is_behind = [&](const Ray& ray) {
        return ray.place == RayPlace::wall || (!line.empty() && ray.origin == line.back());
    };
    const auto end = std::find_if(rays.begin(), rays.end(), is_behind);
    if (end == rays.begin()) return;
    if (line.empty()) line.push_back(end->origin);
    for (auto ray = end; ray != rays.begin();) line.push_back((--ray)->origin);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) edges.push_back({line[i], line[i + 1]});
}

LayerEdges layer_edges(const Layer& layer) {
    LayerEdges result;
    result.walls = edges_of(layer.walls, layer);
    const std::vector<Segment> wall_edges = sorted_together(result.walls),
                               border_edges = sorted_together(edges_of(layer.borders, layer));  // counter-clockwise
    for (std::vector<Segment>& wall : result.walls)
        for (Segment& edge : wall) std::swap(edge.a, edge.b);
    for (std::size_t e = 0; e < layer.rays.size(); ++e) {
        if (!layer.is_open(e) || layer.rays[e].empty()) continue;
        std::vector<Segment>& ends = layer.is_outer(e) ? result.sides : result.symmetry;
        if (!layer.is_outer(e)) add_wake_on_symmetry(layer, e, ends);
        const Ray &first = layer.rays[e].front(), &last = layer.rays[e].back();
        for (std::uint32_t n = 1; n <= first.layers; ++n) ends.push_back({first.vertex(n - 1), first.vertex(n)});
        for (std::uint32_t n = 1; n <= last.layers; ++n) ends.push_back({last.vertex(n), last.vertex(n - 1)});
    }
    result.region = result.sides;
    result.region.insert(result.region.end(), result.symmetry.begin(), result.symmetry.end());

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
        const bool back = layer.is_open(loops.size());
        std::vector<Point>& loop = loops.emplace_back();
        loop.reserve(border.size());
        for (VertexId v : border) loop.push_back(layer.points[v.index()]);
        if (back && loop.size() > 2) loop.insert(loop.end(), loop.rbegin() + 1, loop.rend() - 1);
    }
    return loops;
}

namespace {

using FrontCorners = std::vector<std::vector<FrontCorner>>;

/// Divides the fronts through these corners. least_requests, whole_up_to: as for divide_borders().
BorderDivision divide_fronts(const LayeredRays& rays, const FrontCorners& corners, const BorderOptions& options,
                             std::span<const std::vector<double>> least_requests,
                             std::span<const std::vector<double>> whole_up_to, const PlaceOnWall& place_on_wall) {
    std::vector<std::vector<Point>> fronts(corners.size()), walls(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e) {
        for (const FrontCorner& corner : corners[e]) fronts[e].push_back(place_of(rays, corner));
        for (std::size_t i = rays.set.begin[e]; i < rays.set.begin[e + 1]; ++i) {
            const RayLine& ray = rays.set.lines[i];
            if (walls[e].empty() || walls[e].back() != ray.origin) walls[e].push_back(ray.origin);
            walls[e].insert(walls[e].end(), ray.corner_after.begin(), ray.corner_after.end());
        }
    }
    return divide_borders(fronts, walls, options, least_requests, whole_up_to, place_on_wall);
}

/// Returns what divide_borders() needs to leave the tops of the grid's cells whole.
std::vector<std::vector<double>> whole_tops(const Rays& grown, const FrontCorners& corners) {
    const bool of_grid = grown.topology != LayerTopology::delaunay;
    std::vector<std::vector<double>> whole_up_to(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k) {
            const FrontCorner &a = corners[e][k], &b = corners[e][(k + 1) % corners[e].size()];
            const bool has_cell = a.layers > 0 && b.layers > 0 && !a.cleft;
            const bool whole = uses("whole_tops") && of_grid && grown.resampled[e] && has_cell;
            whole_up_to[e].push_back(whole ? whole_top : alike);
        }
    return whole_up_to;
}

/// The wall between the origins of two rays.
struct WallPart {
    Point a, b;   ///< its ends
    double edge;  ///< length of its edge, or the mean length of its edges where there is a corner between
};

/// Returns the part of the wall below an edge of a front.
WallPart wall_below(const Rays& rays, const std::vector<FrontCorner>& corners, std::size_t k) {
    const RayLine &ray = rays.set.lines[corners[k].ray], &next = rays.set.lines[corners[(k + 1) % corners.size()].ray];
    const Point a = ray.origin, b = next.origin;
    Point from = a;
    double wall = 0;
    for (const Point p : ray.corner_after) {
        wall += distance(from, p);
        from = p;
    }
    return {a, b, (wall + distance(from, b)) / static_cast<double>(ray.corner_after.size() + 1)};
}

/// Returns whether an edge of a front lies above an edge of the wall, rather than of a wake, and would become shorter
/// where the wall becomes finer. Beside lines it is as long as their lean makes it.
bool follows_wall(const Rays& rays, const std::vector<FrontCorner>& corners, std::size_t k) {
    const auto follows = [&](std::size_t corner) {
        const RayLine& ray = rays.set.lines[corners[corner % corners.size()].ray];
        return ray.place == RayPlace::wall && ray.line_room == 0;
    };
    return follows(k) && follows(k + 1);
}

}  // namespace

/// Where rays converge, edges of the front are shorter than those of the wall below. If they requested their own
/// lengths, the wall beside would become finer for them, then the wall below, and then these edges themselves.
std::vector<geometry::WallSpacing> wall_spacings(const Rays& rays, const BorderOptions& options) {
    validate(options);
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(rays);
    std::vector<std::vector<double>> least_requests(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k)
            least_requests[e].push_back(corners[e][k].cleft ? 0 : wall_below(rays, corners[e], k).edge);
    const BorderDivision division = divide_fronts(layered, corners, options, least_requests, {}, {});
    std::vector<geometry::WallSpacing> spacings;
    for (std::size_t e = 0; e < rays.shown(); ++e) {
        if (!rays.resampled[e]) continue;
        const std::size_t shown = corners_in_domain(rays, e, corners[e]) - rays.is_open(e);
        for (std::size_t k = 0; k < shown; ++k) {
            if (corners[e][k].cleft || !follows_wall(rays, corners[e], k)) continue;
            const WallPart wall = wall_below(rays, corners[e], k);
            const double excess = division.excess[e][k] / alike;
            if (wall.a != wall.b && excess > 1)
                spacings.push_back({e, wall.a, wall.b, spacing_margin * wall.edge / excess});
        }
    }
    return spacings;
}

Layer close_border(const Rays& rays, const BorderOptions& options) {
    validate(options);
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(rays);
    const std::vector<std::vector<double>> whole_up_to = whole_tops(rays, corners);
    Layer layer =
        build_layer(rays, corners, divide_fronts(layered, corners, options, {}, whole_up_to, rays.place_on_wall));
    if (rays.enabled) layer.coverage = layer_coverage(rays);
    layer.growth = rays.growth;
    layer.jagged = rays.jagged;
    layer.edges = layer_edges(layer);
    return layer;
}

Layer make_layer(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth,
                 const BorderOptions& border) {
    return close_border(grow_rays(geometry, options, growth), border);
}

Layer make_layer(const Geometry& geometry, const LayerOptions& options, const BorderOptions& border) {
    validate(options);
    return make_layer(geometry, options, layer_growth(options, {.chord = bounding_box(geometry).width()}), border);
}

}  // namespace lamina::layers
