// The largest share of a motion that turns no cell over.
#include <lamina/morph.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "mesh/cell_orientation.hpp"
#include "mesh/cell_text.hpp"
#include "morphing/wall_edges.hpp"

namespace lamina::morphing {

namespace {

constexpr std::size_t no_cell = std::numeric_limits<std::size_t>::max();
constexpr int halvings = 6;

/// Returns whether a cell of the mesh is counter-clockwise with its vertices at these points. Exact.
bool is_counter_clockwise(const Mesh& mesh, std::span<const Point> points, std::size_t cell) {
    Point p[4];
    const bool is_triangle = cell < mesh.triangles.size();
    const VertexId* const v = is_triangle ? mesh.triangles[cell].v : mesh.quads[cell - mesh.triangles.size()].v;
    for (std::size_t i = 0; i < (is_triangle ? 3U : 4U); ++i) {
        p[i] = points[v[i].index()];
        if (!std::isfinite(p[i].x) || !std::isfinite(p[i].y)) return false;
    }
    return (is_triangle ? core::inline_orient2d(p[0], p[1], p[2]) : mesh::quad_orientation(p)) > 0;
}

/// Returns the first cell that is not; no_cell where all are.
std::size_t find_turned_cell(const Mesh& mesh, std::span<const Point> points) {
    constexpr std::size_t grain = std::size_t{1} << 13;
    const auto found = core::parallel_blocks(mesh.triangles.size() + mesh.quads.size(), grain,
                                             [&](std::size_t begin, std::size_t end) {
                                                 for (std::size_t cell = begin; cell < end; ++cell)
                                                     if (!is_counter_clockwise(mesh, points, cell)) return cell;
                                                 return no_cell;
                                             });
    return found.empty() ? no_cell : *std::min_element(found.begin(), found.end());
}

/// Describes a cell that turns over.
MeshDefect stop_at(const Mesh& mesh, std::size_t cell) {
    const VertexId v =
        cell < mesh.triangles.size() ? mesh.triangles[cell].v[0] : mesh.quads[cell - mesh.triangles.size()].v[0];
    return {mesh::cell_text(mesh, cell), mesh.points[v.index()]};
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

}  // namespace

}  // namespace lamina::morphing

namespace lamina {

using namespace morphing;

MorphResult morph(const MorphMap& map, std::span<const Point> wall, const MorphOptions& options) {
    require_wall(map, wall);
    MorphResult result{.points = map.positions(wall)};
    const std::size_t turned = find_turned_cell(map.reference(), result.points);
    if (turned == no_cell) return result;
    find_largest_share(map, wall, turned, result);
    if (!options.as_far_as_possible || result.fraction == 0)
        throw MeshError(
            fmt::format("the motion can be made to {:.3g} % alone: beyond that, {} at ({:.6g}, {:.6g}) turns "
                        "over",
                        100 * result.fraction, result.stop->description, result.stop->at.x, result.stop->at.y),
            result.stop->at);
    return result;
}

}  // namespace lamina
