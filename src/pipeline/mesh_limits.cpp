#include "pipeline/mesh_limits.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <lamina/threads.hpp>

#include "core/bounding_box.hpp"
#include "mesh/cell_lattice.hpp"
#include "surface/clearance.hpp"

namespace lamina::pipeline {

namespace {

// Measured: the processor time and the memory that the sizes and the decoupling take for each edge of the layer's
// border.
constexpr double seconds_per_border_edge = 100e-6, bytes_per_border_edge = 8e3;

/// Returns the number of triangles in the layer, as many as rows of cells between neighbouring rays have halves.
double layer_triangles(const layers::Layer& layer) {
    std::size_t cells = 0;
    for (const ElementCoverage& element : layer.coverage) cells += element.all.made_cells;
    return 2 * static_cast<double>(cells);
}

/// Returns the memory that curved cells take beside straight ones.
double bytes_of_curved_cells(double triangles, unsigned order) {
    // Counted: places and lists of nodes, and the numbers and bends of edges, are 15 bytes for each node of a triangle.
    constexpr double bytes_per_node = 15;
    return order > 1 ? bytes_per_node * mesh::nodes_of_cell(3, order) * triangles : 0;
}

RunEstimate estimate_mesh(const RefineOptions& refine, unsigned order, const layers::Layer& layer,
                          const decoupling::OuterRegion& region, const WorkCost& cost) {
    // Measured: how much more time a triangle of the layer takes than another one, and how much regularization takes.
    constexpr double more_seconds_per_layer_triangle = 0.3e-6, seconds_per_regularized_triangle = 12e-6;
    const double in_layer = layer_triangles(layer);
    double border_edges = 0;
    for (const auto& border : region.borders) border_edges += static_cast<double>(border.size());
    const double isotropic = estimate_triangles(region);
    RunEstimate estimate =
        estimate_run(in_layer + isotropic, cost, thread_count(),
                     seconds_per_border_edge * border_edges + more_seconds_per_layer_triangle * in_layer +
                         (refine.regularize ? seconds_per_regularized_triangle * isotropic : 0));
    estimate.memory_bytes += bytes_per_border_edge * border_edges + bytes_of_curved_cells(estimate.triangles, order);
    return estimate;
}

/// The layer's border above walls, by estimate.
struct BorderForecast {
    double edges = 0;             ///< number of edges
    double narrowest = HUGE_VAL;  ///< width of the narrowest gap that asks for more edges than the wall has
    Point narrowest_at{};         ///< on the wall
};

/// Estimates the number of edges that the border gets above one element.
BorderForecast forecast_border(const Geometry& walls, std::size_t element, const surface::ClearanceSearch& search,
                               double shortest_edge) {
    // Measured in slots of 1e-4 to 1e-6 chords: opposing layers leave about a quarter of a gap to isotropic triangles,
    // and edges of the border are about as long as that.
    constexpr double edge_over_gap = 0.28;
    // The parts that gaps divide an edge of the border into, at most (layers/border/divide_borders.cpp).
    constexpr double max_parts = 128;
    const Element& wall = walls.elements[element];
    const std::vector<Point>& p = wall.points;
    const double shortest = shortest_edge * core::longer_side(core::bounding_box(p));
    BorderForecast forecast;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point a = p[i], b = p[(i + 1) % p.size()];
        const double length = distance(a, b);
        const double gap =
            search.clearance(element, midpoint(a, b), unit(-perpendicular(b - a)), 0, length / edge_over_gap);
        // Walls of resampled elements become finer below their borders.
        const double least = (wall.resampled ? std::min(length, shortest) : length) / max_parts;
        forecast.edges += length / std::clamp(edge_over_gap * gap, least, length);
        if (gap >= forecast.narrowest || edge_over_gap * gap >= length) continue;
        forecast.narrowest = gap;
        forecast.narrowest_at = midpoint(a, b);
    }
    return forecast;
}

}  // namespace

void require_surface_points_within(const SurfaceOptions& options, std::size_t elements, const WorkBudget& budget) {
    if (options.treatment == SurfaceTreatment::keep) return;
    std::size_t points = options.points.value_or(0);
    for (const SideEdges& sides : options.side_edges) points = std::max(points, sides.upper + sides.lower);
    if (points == 0) return;
    const auto edges = static_cast<double>(elements) * static_cast<double>(points);
    RunEstimate estimate = estimate_run(edges, budget.cost, thread_count(), seconds_per_border_edge * edges);
    estimate.memory_bytes += bytes_per_border_edge * edges;
    require_within(budget.limits, estimate,
                   !options.points        ? "points"
                   : options.exact_points ? "exact_points"
                                          : "surface_points",
                   std::to_string(points));
}

void require_layers_within(const layers::LayerGrowth& growth, const Geometry& walls, const WorkBudget& budget) {
    if (!growth.layers) return;
    // Rays may be cut short.
    constexpr double certain = 2;
    double vertices = 0;
    for (const Element& element : walls.elements) vertices += static_cast<double>(element.points.size());
    const double triangles = 2 * vertices * *growth.layers;
    if (triangles > certain * allowed_triangles(budget.limits, budget.cost))
        throw_limit_error(budget.limits, estimate_run(triangles, budget.cost, thread_count()), "layers",
                          fmt::format("{} on {} wall vertices", *growth.layers, vertices));
}

void require_walls_within(const SurfaceOptions& options, const Geometry& prepared, const WorkBudget& budget) {
    // A million rays of any number of layers, or edges above them, are far more than any section needs, and minutes of
    // work before the run could be estimated.
    constexpr double max_edges = 1e6;
    // Gaps are estimated within a factor of two.
    constexpr double certain = 0.5;
    const surface::ClearanceSearch search(prepared);
    double vertices = 0;
    BorderForecast border;
    for (std::size_t e = 0; e < prepared.elements.size(); ++e) {
        vertices += static_cast<double>(prepared.elements[e].points.size());
        const BorderForecast own = forecast_border(prepared, e, search, options.min_spacing);
        border.edges += own.edges;
        if (own.narrowest >= border.narrowest) continue;
        border.narrowest = own.narrowest;
        border.narrowest_at = own.narrowest_at;
    }
    const bool by_gaps = border.edges > 2 * vertices;
    const std::string request = by_gaps ? fmt::format("the gap of {:.2g} between walls at ({:.6g}, {:.6g})",
                                                      border.narrowest, border.narrowest_at.x, border.narrowest_at.y)
                                        : fmt::format("the walls' {} vertices", vertices);
    const char* const option = by_gaps ? "transform" : "surface";
    RunEstimate estimate = estimate_run(2 * vertices + certain * border.edges, budget.cost, thread_count(),
                                        seconds_per_border_edge * certain * border.edges);
    estimate.memory_bytes += bytes_per_border_edge * certain * border.edges;
    require_within(budget.limits, estimate, option, request);
    if (const double edges = std::max(vertices, border.edges); edges > max_edges)
        throw LimitError(option,
                         fmt::format("{} asks for about {:.2g} million edges of the layer's border, and no more than a "
                                     "million are made: {}",
                                     request, 1e-6 * edges,
                                     by_gaps ? "move the elements apart, or close the gap" : "give fewer points"),
                         estimate);
}

RunEstimate estimate_within_limits(const RefineOptions& refine, unsigned order, double gradation,
                                   const layers::Layer& layer, const decoupling::OuterRegion& region,
                                   const WorkBudget& budget) {
    const RunEstimate estimate = estimate_mesh(refine, order, layer, region, budget.cost);
    if (const double in_layer = layer_triangles(layer); in_layer > 0.5 * estimate.triangles)
        require_within(budget.limits, estimate, "layers",
                       fmt::format("the mesh, with {:.2g} triangles in the layer,", in_layer));
    require_within(budget.limits, estimate, "gradation",
                   fmt::format("{}, with these sizes at walls and sources and this far field,", gradation));
    return estimate;
}

double triangles_beyond_layer(const RunEstimate& estimate, const layers::Layer& layer) {
    return estimate.triangles - layer_triangles(layer);
}

RefineOptions refine_within(RefineOptions refine, double chord, const WorkBudget& budget) {
    refine.unit_length = chord;
    refine.max_points = allowed_points(budget.limits, budget.cost, refine.max_points);
    return refine;
}

void require_made_within(const WorkBudget& budget, const MeshCounts& counts) {
    lamina::require_made_within(budget.limits,
                                static_cast<double>(counts.triangles) + 2 * static_cast<double>(counts.quads),
                                budget.cost, thread_count());
}

}  // namespace lamina::pipeline
