#include "adaptation/wall_flow.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <lamina/error.hpp>

#include "adaptation/cell_gradients.hpp"
#include "adaptation/vertex_patches.hpp"
#include "core/angles.hpp"
#include "core/parallel.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::adaptation {

namespace {

/// Velocity and vorticity in the cells, over the speed of the free stream.
struct CellFlow {
    std::vector<Point> velocity;
    std::vector<double> vorticity;
};

/// Returns the flow in the cells from velocities at vertices: their mean, and the circulation round the cell over its
/// area.
CellFlow flow_from_vertices(const Mesh& mesh, std::span<const double> x, std::span<const double> y) {
    const mesh::CellEdges cells(mesh);
    CellFlow flow{std::vector<Point>(cells.cells()), std::vector<double>(cells.cells())};
    core::parallel_for(cells.cells(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell) {
            const std::size_t n = cells.corners(cell);
            const Point origin = mesh.points[cells.corner(cell, 0).index()];
            double circulation = 0, doubled_area = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const std::size_t a = cells.corner(cell, i).index(), b = cells.corner(cell, (i + 1) % n).index();
                const Point edge = mesh.points[b] - mesh.points[a];
                circulation += 0.5 * dot(Point{x[a] + x[b], y[a] + y[b]}, edge);
                doubled_area += cross(mesh.points[a] - origin, mesh.points[b] - origin);
                flow.velocity[cell] = flow.velocity[cell] + (1.0 / static_cast<double>(n)) * Point{x[a], y[a]};
            }
            flow.vorticity[cell] = 2 * circulation / doubled_area;
        }
    });
    return flow;
}

CellFlow flow_from_cells(const Mesh& mesh, std::span<const double> x, std::span<const double> y) {
    const CellReconstruction cells(mesh);
    const std::vector<Point> of_x = cells.gradients(x), of_y = cells.gradients(y);
    CellFlow flow;
    for (std::size_t cell = 0; cell < x.size(); ++cell) {
        flow.velocity.push_back({x[cell], y[cell]});
        flow.vorticity.push_back(of_y[cell].x - of_x[cell].y);
    }
    return flow;
}

/// Returns the mean speed in the cells on the far field.
double speed_of_free_stream(const Mesh& mesh, const CellFlow& flow, const mesh::CellEdges& cells) {
    double sum = 0, count = 0;
    for (const Marker& marker : mesh.markers) {
        if (marker.kind != MarkerKind::far_field) continue;
        for (const std::uint32_t edge : mesh::find_edges(mesh, marker.edges)) {
            sum += std::sqrt(squared_length(flow.velocity[cells.cell_of(edge)]));
            ++count;
        }
    }
    if (!(sum > 0)) throw OptionError("velocity", "is 0 on the far field, or the mesh has no far field");
    return sum / count;
}

/// Walks from walls into the flow, from cell to cell across their edges.
class NormalWalk {
public:
    NormalWalk(const Mesh& mesh, const CellFlow& flow, double speed)
        : mesh_(mesh),
          flow_(flow),
          speed_(speed),
          cells_(mesh),
          adjacency_(mesh::find_adjacency(mesh)),
          isotropic_(isotropic_cells(mesh)),
          middles_(cell_middles(mesh)) {}

    /// Fills in what lies above the middle of an edge. `edge` is that of the cell on the wall.
    void measure(std::uint32_t edge, double viscosity, double reach, WallFlowEdge& wall) const {
        const Point a = mesh_.points[cells_.origin(edge).index()], b = mesh_.points[cells_.target(edge).index()];
        const Point normal = perpendicular(unit(b - a));  // the mesh lies on the left
        wall.cell = static_cast<std::uint32_t>(cells_.cell_of(edge));
        wall.ends = {cells_.target(edge), cells_.origin(edge)};
        wall.at = midpoint(a, b);
        wall.length = distance(a, b);
        const double along = dot(flow_.velocity[wall.cell], unit(a - b)) / speed_;
        const double away = dot(middles_[wall.cell] - wall.at, normal);
        wall.friction = along / away;
        // y+ = y u_tau / nu with u_tau^2 = nu du/dn.
        wall.wall_unit = std::sqrt(viscosity / std::max(std::abs(wall.friction), 1e-300));
        climb(edge, normal, reach, wall);
    }

private:
    /// A cell that the way crosses.
    struct Step {
        double begin, end;  ///< distances from the wall
        std::size_t cell;
    };

    /// Returns the edge through which the way leaves the cell that it has entered through `edge`, and the distance
    /// there.
    std::optional<std::pair<std::uint32_t, double>> exit_of(std::uint32_t edge, Point from, Point normal) const {
        const std::size_t cell = cells_.cell_of(edge);
        for (std::size_t e = cells_.first(cell); e < cells_.first(cell + 1); ++e) {
            if (e == edge) continue;
            const Point a = mesh_.points[cells_.origin(e).index()] - from,
                        b = mesh_.points[cells_.target(e).index()] - from;
            // Cells are counter-clockwise: the way goes out where an edge runs from its right to its left.
            const double of_a = cross(normal, a), of_b = cross(normal, b);
            if (of_a > 0 || of_b < 0 || of_a == of_b) continue;
            const double share = of_a / (of_a - of_b);
            return std::pair{static_cast<std::uint32_t>(e), dot(normal, a + share * (b - a))};
        }
        return {};
    }

    void climb(std::uint32_t edge, Point normal, double reach, WallFlowEdge& wall) const {
        std::vector<Step> steps;
        bool in_layer = true;
        for (double height = 0; height < reach && steps.size() < cells_.cells();) {
            const auto exit = exit_of(edge, wall.at, normal);
            if (!exit) break;
            const std::size_t cell = cells_.cell_of(edge);
            const double end = std::max(exit->second, height);
            steps.push_back({height, end, cell});
            in_layer = in_layer && !isotropic_[cell];
            if (in_layer) {
                wall.layers += 0.5 * static_cast<double>(cells_.corners(cell) - 2);
                wall.layer_height = end;
                wall.column.push_back(static_cast<std::uint32_t>(cell));
                wall.tops.push_back(end);
            }
            height = end;
            edge = adjacency_.twin[exit->first];
            if (edge == mesh::no_edge) break;
        }
        wall.thickness = thickness_of(steps);
    }

    /// Returns 0 where no end is found, as at stagnation points.
    double thickness_of(const std::vector<Step>& steps) const {
        constexpr double negligible = 0.02;
        double whole = 0;
        for (const Step& step : steps) whole += (step.end - step.begin) * flow_.vorticity[step.cell];
        // Flow along the wall that runs back under a separated layer ends nothing.
        const double forward = whole < 0 ? -1 : 1;
        double induced = 0;
        for (const Step& step : steps) {
            induced += forward * (step.end - step.begin) * flow_.vorticity[step.cell];
            if (induced > 0 && step.end * std::abs(flow_.vorticity[step.cell]) < negligible * induced)
                return step.begin;
        }
        return 0;
    }

    const Mesh& mesh_;
    const CellFlow& flow_;
    double speed_;
    mesh::CellEdges cells_;
    mesh::Adjacency adjacency_;
    std::vector<char> isotropic_;
    std::vector<Point> middles_;
};

/// Marks the edges at whose ends the wall turns sharply.
void mark_corners(const Mesh& mesh, WallFlow& wall) {
    constexpr double sharp = core::radians(30);
    const auto direction = [&](const WallFlowEdge& edge) {
        return mesh.points[edge.ends.b.index()] - mesh.points[edge.ends.a.index()];
    };
    for (std::size_t i = 0; i < wall.size(); ++i) {
        const std::size_t next = (i + 1) % wall.size();
        if (std::abs(core::angle_between(direction(wall[i]), direction(wall[next]))) < sharp) continue;
        wall[i].at_corner = wall[next].at_corner = true;
    }
}

/// Returns the thicknesses above an edge and up to three edges to both sides, as far as no corner lies between.
std::vector<double> thicknesses_near(const WallFlow& wall, std::size_t edge) {
    const std::size_t n = wall.size(), reach = std::min<std::size_t>(3, (n - 1) / 2);
    std::vector<double> near{wall[edge].thickness};
    for (const std::size_t step : {std::size_t{1}, n - 1}) {
        std::size_t at = edge;
        for (std::size_t k = 0; k < reach; ++k) {
            const std::size_t beside = (at + step) % n;
            if (wall[at].at_corner && wall[beside].at_corner) break;
            at = beside;
            near.push_back(wall[at].thickness);
        }
    }
    return near;
}

/// Gives each edge the running median of the thicknesses. Vorticity that errors of the solution make outside of the
/// layer hides the end of it above single edges, which then is found at a hundred times the distance, or not at all.
/// Source: J. W. Tukey, Exploratory Data Analysis (1977), chapter 7.
void smooth_thicknesses(WallFlow& wall) {
    std::vector<double> medians;
    for (std::size_t i = 0; i < wall.size(); ++i) {
        std::vector<double> near = thicknesses_near(wall, i);
        const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
        std::nth_element(near.begin(), middle, near.end());
        medians.push_back(*middle);
    }
    for (std::size_t i = 0; i < wall.size(); ++i) wall[i].thickness = medians[i];
}

}  // namespace

std::vector<WallFlow> find_wall_flow(const Solution& solution, const WallFlowOptions& options) {
    // Boundary layers are sought up to this share of the length of their wall.
    constexpr double reach = 0.1;
    const Mesh& mesh = solution.mesh;
    const std::vector<std::string> names = options.components();
    const SolutionField &x = field_named(solution, names[0], "velocity"),
                        &y = field_named(solution, names[1], "velocity");
    for (const SolutionField* field : {&x, &y}) require_fitting(mesh, *field);
    const CellFlow flow =
        x.at_cells ? flow_from_cells(mesh, x.values, y.values) : flow_from_vertices(mesh, x.values, y.values);
    const mesh::CellEdges cells(mesh);
    const NormalWalk walk(mesh, flow, speed_of_free_stream(mesh, flow, cells));
    const WallVertices vertices = wall_vertices(mesh);
    std::vector<WallFlow> walls;
    for (std::size_t body = 0; body + 1 < vertices.body_first.size(); ++body) {
        const std::size_t first = vertices.body_first[body], n = vertices.body_first[body + 1] - first;
        std::vector<Segment> edges;
        for (std::size_t i = 0; i < n; ++i)
            edges.push_back({vertices.vertex[first + i], vertices.vertex[first + (i + 1) % n]});
        std::vector<std::uint32_t> of_cells = mesh::find_edges(mesh, edges);
        std::erase(of_cells, mesh::no_edge);  // an open wall has no edge from its end to its beginning
        WallFlow& wall = walls.emplace_back(of_cells.size());
        const double length = vertices.arc_length[first + n - 1];
        core::parallel_for(wall.size(), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                walk.measure(of_cells[i], options.viscosity, reach * length, wall[i]);
        });
        mark_corners(mesh, wall);
        smooth_thicknesses(wall);
    }
    if (walls.empty()) throw OptionError("solution", "has a mesh without walls");
    return walls;
}

}  // namespace lamina::adaptation
