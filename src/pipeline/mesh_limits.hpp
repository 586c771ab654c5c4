// The size of a mesh by estimate, and the refusal of runs that would exceed their limits.
#pragma once

#include <lamina/mesh_sink.hpp>
#include <lamina/pipeline.hpp>

#include "decoupling/subdomain.hpp"
#include "layers/layer.hpp"
#include "pipeline/outer_walls.hpp"

namespace lamina::pipeline {

/// The cost of stream_mesh(): what remains in memory are the borders of all pieces (docs/decisions/0045).
inline constexpr WorkCost stream_cost{40e6, 2.5, 0.35e-6};

/// Returns the cost of share_mesh() for each of this many processes, which keep their pieces in memory or not.
constexpr WorkCost shared_cost(unsigned processes, bool in_memory) {
    return {40e6, 2.5 + (in_memory ? 24.0 : 0.0) / processes, 0.35e-6 / processes};
}

/// The limits on the work, and what a triangle costs.
struct WorkBudget {
    const WorkLimits& limits;
    WorkCost cost;
};

/// Throws LimitError where the number of edges that walls are to have asks for more than the limits allow: a triangle,
/// and an edge of the layer's border, for each. It takes no time.
void require_surface_points_within(const SurfaceOptions& options, std::size_t elements, const WorkBudget& budget);

/// Throws LimitError where the number of layers alone asks for far more triangles than the limits allow. It takes no
/// time.
void require_layers_within(const layers::LayerGrowth& growth, const Geometry& walls, const WorkBudget& budget);

/// Throws LimitError where these walls, which the layer is to grow from, ask for more than the limits allow, or for
/// more than a million rays or edges of the layer's border: where walls are near to each other, these edges are shorter
/// than the gap. Takes less than a second.
void require_walls_within(const SurfaceOptions& options, const Geometry& prepared, const WorkBudget& budget);

/// Estimates the run from the layer and the region beyond it, for cells of this order. Throws LimitError where it would
/// exceed the limits; the error names the gradation of the sizes.
RunEstimate estimate_within_limits(const RefineOptions& refine, unsigned order, double gradation,
                                   const layers::Layer& layer, const decoupling::OuterRegion& region,
                                   const WorkBudget& budget);

/// Returns how many triangles the estimate has beyond the layer.
double triangles_beyond_layer(const RunEstimate& estimate, const layers::Layer& layer);

/// Returns the options of refinement round a configuration of this reference chord, with which no subdomain goes beyond
/// the limits. Estimates may be wrong.
RefineOptions refine_within(RefineOptions refine, double chord, const WorkBudget& budget);

/// Throws LimitError where the mesh made has more triangles than allowed, since the estimate was too low.
void require_made_within(const WorkBudget& budget, const MeshCounts& counts);

}  // namespace lamina::pipeline
