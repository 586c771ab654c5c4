#include "pipeline/mesh_limits.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <lamina/threads.hpp>

namespace lamina::pipeline {

namespace {

// Measured: the processor time and the memory that the sizes and the decoupling take for each edge of the layer's border.
constexpr double seconds_per_border_edge = 100e-6, bytes_per_border_edge = 8e3;

/// Returns the number of triangles in the layer, as many as rows of cells between neighbouring rays have halves.
double layer_triangles(const Layer& layer) {
    std::size_t cells = 0;
    for (const ElementCoverage& element : layer.coverage) cells += element.all.made_cells;
    return 2 * static_cast<double>(cells);
}

RunEstimate estimate_mesh(const RefineOptions& refine, const Layer& layer, const SizeField& size,
                          const FarField& far_field, const WorkCost& cost) {
    // Measured: how much more time a triangle of the layer takes than another one, and how much regularization takes.
    constexpr double more_seconds_per_layer_triangle = 0.3e-6, seconds_per_regularized_triangle = 12e-6;
    const double in_layer = layer_triangles(layer);
    double border_edges = 0;
    for (const auto& border : layer.borders) border_edges += static_cast<double>(border.size());
    const double isotropic = estimate_triangles(layer.points, layer.borders, size, far_field);
    RunEstimate estimate =
        estimate_run(in_layer + isotropic, cost, thread_count(),
                     seconds_per_border_edge * border_edges + more_seconds_per_layer_triangle * in_layer +
                         (refine.regularize ? seconds_per_regularized_triangle * isotropic : 0));
    estimate.memory_bytes += bytes_per_border_edge * border_edges;
    return estimate;
}

}  // namespace

void require_surface_points_within(const CaseOptions& options, std::size_t elements, const WorkCost& cost) {
    if (!options.surface.points || options.surface.treatment == SurfaceTreatment::keep) return;
    const auto edges = static_cast<double>(elements) * static_cast<double>(*options.surface.points);
    RunEstimate estimate = estimate_run(edges, cost, thread_count(), seconds_per_border_edge * edges);
    estimate.memory_bytes += bytes_per_border_edge * edges;
    require_within(options.limits, estimate, "surface_points", std::to_string(*options.surface.points));
}

void require_options_within(const CaseOptions& options, const LayerGrowth& growth, const SizedBodies& bodies,
                            const Box& domain, const WorkCost& cost) {
    require_within_limits(options.sizing, bodies, domain, options.limits);
    if (!options.layer.enabled || !growth.layers) return;
    // Rays may be cut short.
    constexpr double certain = 2;
    double vertices = 0;
    for (const auto& wall : bodies.walls) vertices += static_cast<double>(wall.size());
    const double triangles = 2 * vertices * *growth.layers;
    if (triangles > certain * allowed_triangles(options.limits, cost))
        throw_limit_error(options.limits, estimate_run(triangles, cost, thread_count()), "layers",
                          fmt::format("{} on {} wall vertices", *growth.layers, vertices));
}

RunEstimate estimate_within_limits(const CaseOptions& options, const Layer& layer, const SizeField& size,
                                   const FarField& far_field, const WorkCost& cost) {
    const RunEstimate estimate = estimate_mesh(options.refine, layer, size, far_field, cost);
    if (const double in_layer = layer_triangles(layer); in_layer > 0.5 * estimate.triangles)
        require_within(options.limits, estimate, "layers",
                       fmt::format("the mesh, with {:.2g} triangles in the layer,", in_layer));
    require_within(
        options.limits, estimate, "gradation",
        fmt::format("{}, with these sizes at walls and sources and this far field,", options.sizing.gradation));
    return estimate;
}

double triangles_beyond_layer(const RunEstimate& estimate, const Layer& layer) {
    return estimate.triangles - layer_triangles(layer);
}

RefineOptions refine_options(const CaseOptions& options, double chord, const WorkCost& cost) {
    RefineOptions refine = options.refine;
    refine.unit_length = chord;
    refine.max_points = allowed_points(options.limits, cost, refine.max_points);
    return refine;
}

void require_made_within(const WorkLimits& limits, std::size_t triangles, std::size_t quads, const WorkCost& cost) {
    lamina::require_made_within(limits, static_cast<double>(triangles) + 2 * static_cast<double>(quads), cost,
                                thread_count());
}

}  // namespace lamina::pipeline
