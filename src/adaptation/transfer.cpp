// Carries fields to another mesh.
#include <lamina/transfer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/delaunay_queries.hpp>
#include <lamina/error.hpp>

#include "adaptation/cell_gradients.hpp"
#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/segments.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::adaptation {

namespace {

constexpr std::size_t grain = 1024;

/// Edges that know which of them is nearest to a point.
class NearestEdge {
public:
    struct Place {
        std::size_t edge = 0;
        double share = 0;  ///< 0 at the edge's a, 1 at its b
        Point at{};
    };

    NearestEdge(std::span<const Point> points, std::vector<Segment> edges)
        : points_(points), edges_(std::move(edges)), tree_(boxes_of(points_, edges_)) {}

    bool empty() const { return edges_.empty(); }
    const Segment& edge(std::size_t i) const { return edges_[i]; }
    /// Precondition: !empty()
    Place to(Point p) const {
        Place nearest;
        double least = HUGE_VAL;
        tree_.min_distance(p, HUGE_VAL, [&](std::size_t i) {
            const Point a = points_[edges_[i].a.index()], b = points_[edges_[i].b.index()];
            const double share = core::share_along(p, a, b);
            const Point at = a + share * (b - a);
            const double away = distance(p, at);
            if (away < least) {
                least = away;
                nearest = {i, share, at};
            }
            return away;
        });
        return nearest;
    }

private:
    static std::vector<Box> boxes_of(std::span<const Point> points, const std::vector<Segment>& edges) {
        std::vector<Box> boxes(edges.size());
        for (std::size_t i = 0; i < edges.size(); ++i)
            boxes[i] = core::bounding_box(points[edges[i].a.index()], points[edges[i].b.index()]);
        return boxes;
    }

    std::span<const Point> points_;
    std::vector<Segment> edges_;
    core::BoxTree tree_;
};

std::vector<Segment> wall_edges(const Mesh& mesh) {
    std::vector<Segment> edges;
    for (const Marker& marker : mesh.markers)
        if (marker.kind == MarkerKind::wall) edges.insert(edges.end(), marker.edges.begin(), marker.edges.end());
    return edges;
}

/// Where a value comes from: three vertices with weights, and the cell that they belong to.
struct Stencil {
    std::array<VertexId, 3> vertices{};
    std::array<double, 3> weights{};
    std::uint32_t cell = 0;
    Point at{};  ///< the place itself, or the nearest one in the mesh
};

/// Finds places in the mesh of a solution.
class Locator {
public:
    Locator(const Mesh& from, const Mesh& to)
        : mesh_(from),
          triangles_(split(from)),
          index_(from.points, triangles_),
          boundary_(from.points, boundary_edges(from)),
          old_walls_(from.points, wall_edges(from)),
          new_walls_(to.points, wall_edges(to)) {}

    std::vector<Stencil> stencils(std::vector<Point> places) const {
        if (!old_walls_.empty() && !new_walls_.empty())
            core::parallel_for(places.size(), grain, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) places[i] = moved_with_walls(places[i]);
            });
        const std::vector<PointLocation> locations = index_.locate(places);
        std::vector<Stencil> stencils(places.size());
        core::parallel_for(places.size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const bool outside = locations[i].place == PointPlace::outside;
                stencils[i] = outside ? nearest(places[i]) : inside(locations[i].triangle, places[i]);
            }
        });
        return stencils;
    }

private:
    /// Returns the triangles, then two halves of each quad.
    static std::vector<Triangle> split(const Mesh& mesh) {
        std::vector<Triangle> triangles = mesh.triangles;
        for (const Quad& quad : mesh.quads) {
            const auto& v = quad.v;
            const auto area = [&](int a, int b, int c) {
                const Point p = mesh.points[v[a].index()];
                return cross(mesh.points[v[b].index()] - p, mesh.points[v[c].index()] - p);
            };
            // A quad with a corner beyond 180 degrees has one diagonal alone.
            const bool first = std::min(area(0, 1, 2), area(0, 2, 3)) >= std::min(area(0, 1, 3), area(1, 2, 3));
            triangles.push_back({{v[0], v[1], first ? v[2] : v[3]}});
            triangles.push_back({{first ? v[0] : v[1], v[2], v[3]}});
        }
        return triangles;
    }
    std::uint32_t cell_of(std::size_t triangle) const {
        const std::size_t whole = mesh_.triangles.size();
        return static_cast<std::uint32_t>(triangle < whole ? triangle : whole + (triangle - whole) / 2);
    }
    std::vector<Segment> boundary_edges(const Mesh& mesh) {
        const mesh::CellEdges edges(mesh);
        std::vector<Segment> boundary;
        for (const std::uint32_t e : mesh::find_adjacency(mesh).boundary) {
            boundary.push_back({edges.origin(e), edges.target(e)});
            boundary_cells_.push_back(static_cast<std::uint32_t>(edges.cell_of(e)));
        }
        return boundary;
    }
    /// Moves a place by what parts the two divisions of the wall there. Far from the wall in comparison it stays.
    Point moved_with_walls(Point p) const {
        // The walls move places that are up to so many moves away, so that distances change by a hundredth at most.
        constexpr double reach = 100;
        const Point foot = new_walls_.to(p).at;
        const Point move = old_walls_.to(foot).at - foot;
        const double limit = reach * std::sqrt(squared_length(move)), away = distance(p, foot);
        return away < limit ? p + (1 - away / limit) * move : p;
    }
    Stencil inside(TriangleId triangle, Point p) const {
        const auto& v = triangles_[triangle.index()].v;
        const Point a = mesh_.points[v[0].index()], b = mesh_.points[v[1].index()], c = mesh_.points[v[2].index()];
        const double area = cross(b - a, c - a);
        // Rounding leaves no weight below 0.
        const double of_b = std::clamp(cross(p - a, c - a) / area, 0.0, 1.0);
        const double of_c = std::clamp(cross(b - a, p - a) / area, 0.0, 1.0 - of_b);
        return {{v[0], v[1], v[2]}, {1 - of_b - of_c, of_b, of_c}, cell_of(triangle.index()), p};
    }
    Stencil nearest(Point p) const {
        const NearestEdge::Place place = boundary_.to(p);
        const Segment& edge = boundary_.edge(place.edge);
        return {{edge.a, edge.b, edge.b}, {1 - place.share, place.share, 0}, boundary_cells_[place.edge], place.at};
    }

    const Mesh& mesh_;
    std::vector<Triangle> triangles_;
    TriangulationIndex index_;
    std::vector<std::uint32_t> boundary_cells_;  ///< per edge of the boundary; stands before it, which fills it
    NearestEdge boundary_, old_walls_, new_walls_;
};

std::vector<double> values_at(const std::vector<double>& values, const std::vector<Stencil>& stencils) {
    std::vector<double> result;
    result.reserve(stencils.size());
    for (const Stencil& stencil : stencils) {
        double value = 0;
        for (std::size_t i = 0; i < 3; ++i) value += stencil.weights[i] * values[stencil.vertices[i].index()];
        result.push_back(value);
    }
    return result;
}

std::vector<double> values_in_cells(const std::vector<double>& values, const std::vector<Stencil>& stencils,
                                    const CellReconstruction& cells) {
    const std::vector<Point> gradients = cells.gradients(values);
    const double least = values.empty() ? 0 : *std::min_element(values.begin(), values.end());
    std::vector<double> result;
    result.reserve(stencils.size());
    for (const Stencil& stencil : stencils) {
        const double value =
            values[stencil.cell] + dot(gradients[stencil.cell], stencil.at - cells.middle(stencil.cell));
        const bool loses_sign = (least > 0 && !(value > 0)) || (least == 0 && value < 0);
        result.push_back(loses_sign ? values[stencil.cell] : value);
    }
    return result;
}

}  // namespace

}  // namespace lamina::adaptation

namespace lamina {

using namespace adaptation;

std::vector<SolutionField> transfer(const Solution& solution, const Mesh& mesh) {
    for (const SolutionField& field : solution.fields) require_fitting(solution.mesh, field);
    const Locator locator(solution.mesh, mesh);
    std::vector<Stencil> at_vertices, at_cells;
    const bool any_cells = std::any_of(solution.fields.begin(), solution.fields.end(),
                                       [](const SolutionField& field) { return field.at_cells; });
    const bool any_vertices = std::any_of(solution.fields.begin(), solution.fields.end(),
                                          [](const SolutionField& field) { return !field.at_cells; });
    if (any_vertices) at_vertices = locator.stencils(mesh.points);
    if (any_cells) at_cells = locator.stencils(cell_middles(mesh));
    std::optional<CellReconstruction> cells;
    if (any_cells) cells.emplace(solution.mesh);
    std::vector<SolutionField> result;
    for (const SolutionField& field : solution.fields)
        result.push_back(
            {field.name, field.at_cells,
             field.at_cells ? values_in_cells(field.values, at_cells, *cells) : values_at(field.values, at_vertices)});
    return result;
}

}  // namespace lamina
