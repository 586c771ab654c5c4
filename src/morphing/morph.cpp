// The largest share of a motion that turns no cell over.
#include <lamina/morph.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/cell_orientation.hpp"
#include "mesh/cell_text.hpp"
#include "morphing/bodies.hpp"

namespace lamina::morphing {

namespace {

constexpr std::size_t no_cell = std::numeric_limits<std::size_t>::max();
constexpr int halvings = 6;

/// Returns whether a cell is counter-clockwise with its vertices at these points. Exact.
bool is_counter_clockwise(const mesh::CellEdges& cells, std::span<const Point> points, std::size_t cell) {
    Point p[4];
    const std::size_t corners = cells.corners(cell);
    for (std::size_t i = 0; i < corners; ++i) {
        p[i] = points[cells.corner(cell, i).index()];
        if (!std::isfinite(p[i].x) || !std::isfinite(p[i].y)) return false;
    }
    return (corners == 3 ? core::inline_orient2d(p[0], p[1], p[2]) : mesh::quad_orientation(p)) > 0;
}

/// Returns the first cell that is not; no_cell where all are.
std::size_t find_turned_cell(const Mesh& mesh, std::span<const Point> points) {
    const mesh::CellEdges cells(mesh);
    const auto found =
        core::parallel_blocks(cells.cells(), mesh::cells_per_block, [&](std::size_t begin, std::size_t end) {
            for (std::size_t cell = begin; cell < end; ++cell)
                if (!is_counter_clockwise(cells, points, cell)) return cell;
            return no_cell;
        });
    return found.empty() ? no_cell : *std::min_element(found.begin(), found.end());
}

/// Describes a cell that turns over.
MeshDefect stop_at(const Mesh& mesh, std::size_t cell) {
    return {mesh::cell_text(mesh, cell), mesh.points[mesh::CellEdges(mesh).corner(cell, 0).index()]};
}

void require_wall(const MorphMap& map, std::span<const Point> wall) {
    const std::size_t n = map.wall_points().size();
    if (wall.size() != n)
        throw InputError({}, fmt::format("{} points for the {} wall vertices of the mesh", wall.size(), n));
    for (std::size_t i = 0; i < n; ++i)
        if (!std::isfinite(wall[i].x) || !std::isfinite(wall[i].y))
            throw InputError({.at = map.wall_points()[i], .points = {i}}, "a wall vertex moves to no finite place");
    for (const Segment& edge : edges_of_walls(map.reference(), map.walls()))
        if (wall[edge.a.index()] == wall[edge.b.index()])
            throw InputError({.at = wall[edge.a.index()], .points = {edge.a.index(), edge.b.index()}},
                             "two neighbours of a wall move to one place");
}

/// Throws InputError where an outline would cross itself or another one: that says more than the cell that turns over.
void require_bodies_apart(const MorphMap& map, std::span<const Point> wall) {
    try {
        check_simple(as_geometry(closed_bodies(map), wall));
    } catch (const InputError& error) {
        throw InputError({.at = error.place().at}, "the walls would cross or touch where they move to");
    }
}

/// Returns the wall points a share of their way.
std::vector<Point> part_of_way(std::span<const Point> from, std::span<const Point> to, double share) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < from.size(); ++i) points.push_back(from[i] + share * (to[i] - from[i]));
    return points;
}

/// Halves the interval between a share that turns no cell over and one that does, and keeps the former's points and the
/// cell that turns over at the latter.
void find_largest_share(const MorphMap& map, std::span<const Point> wall, std::size_t cell, MorphResult& result) {
    double below = 0, above = 1;
    result.points = map.reference().points;
    for (int k = 0; k < halvings; ++k) {
        const double share = 0.5 * (below + above);
        std::vector<Point> points = map.positions(part_of_way(map.wall_points(), wall, share));
        const std::size_t turned = find_turned_cell(map.reference(), points);
        if (turned == no_cell) {
            below = share;
            result.points = std::move(points);
        } else {
            above = share;
            cell = turned;
        }
    }
    result.fraction = below;
    result.stop = stop_at(map.reference(), cell);
}

/// Moves the walls as far as the map can.
MorphResult move_by(const MorphMap& map, std::span<const Point> wall) {
    MorphResult result{.points = map.positions(wall)};
    const std::size_t turned = find_turned_cell(map.reference(), result.points);
    if (turned != no_cell) find_largest_share(map, wall, turned, result);
    return result;
}

/// Goes on by a new map of the mesh half as far as the last one got, until one gets to the end. A mesh at the end of
/// what a map can do has cells that nearly turn over, which would stop the next map. `result` is that of the first map.
///
/// A slat of a high-lift section moved across its slot by 2 % of the chord, up or down, takes 2 and 3 maps where one
/// goes 58 % and 66 % of the way; a flap turned by 10 degrees, whose slot closes to 44 %, takes 6 for 66 %. A map that
/// advances by less than a quarter of what the one before did meets walls that do; 64ths of the motion would take too
/// many.
void go_on_by_further_maps(const MorphMap& first, std::span<const Point> wall, MorphResult& result) {
    constexpr double least_advance = 0.25, least_share = 1. / 64, share_of_reach = 0.5;
    const MorphMap* map = &first;
    std::unique_ptr<const Mesh> mesh;
    std::optional<MorphMap> further;
    double made = 0, reach = result.fraction;                    // reach: a share of what is left
    double advance = result.fraction, advance_before = advance;  // shares of the whole
    while (result.stop && advance >= least_share && advance >= least_advance * advance_before) {
        auto next = std::make_unique<Mesh>(first.reference());
        next->points = map->positions(part_of_way(map->wall_points(), wall, share_of_reach * reach));
        if (find_turned_cell(*next, next->points) != no_cell) return;
        made += (1 - made) * share_of_reach * reach;
        further.emplace(*next);
        mesh = std::move(next);
        map = &*further;
        MorphResult rest = move_by(*map, wall);
        reach = rest.fraction;
        advance_before = std::exchange(advance, (1 - made) * reach);
        result = {std::move(rest.points), made + advance, std::move(rest.stop), result.maps + 1};
    }
}

}  // namespace

}  // namespace lamina::morphing

namespace lamina {

using namespace morphing;

MorphResult morph(const MorphMap& map, std::span<const Point> wall, const MorphOptions& options) {
    require_wall(map, wall);
    MorphResult result = move_by(map, wall);
    if (options.incremental) go_on_by_further_maps(map, wall, result);
    if (!result.stop) return result;
    if (!options.as_far_as_possible || result.fraction == 0) {
        require_bodies_apart(map, wall);
        throw MeshError(
            fmt::format("the motion can be made to {:.3g} % alone: beyond that, {} at ({:.6g}, {:.6g}) turns "
                        "over",
                        100 * result.fraction, result.stop->description, result.stop->at.x, result.stop->at.y),
            result.stop->at);
    }
    return result;
}

}  // namespace lamina
