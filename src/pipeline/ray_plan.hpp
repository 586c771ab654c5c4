// The rays that a mesh is made on: planned with the walls below them, and shortened where the mesh shows that it must
// be.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/pipeline.hpp>

#include "layers/stages.hpp"
#include "mesh/piece_check.hpp"
#include "pipeline/flow_guidance.hpp"

namespace lamina::pipeline {

/// The walls, the far field round them, the rays on them, and the sizes that their fronts and the options request.
struct RayPlan {
    Geometry geometry;
    ReferenceConditions conditions;
    FarField far_field;
    layers::Rays rays;
    SizeRequests requests;
    std::vector<ElementWake> wakes{};       ///< of the flow, one per element or none
    std::vector<double> first_front{};      ///< of the rays, before any was shortened
    std::size_t thinned_rays = 0;           ///< MeshResult::thinned_rays
    Point thinned_at{};                     ///< MeshResult::thinned_at
    std::vector<SizeSource> short_edges{};  ///< further sizes for the edges of borders
};

/// Columns end below cells of the layer with larger angles than this, and `large_angle` warns of those that are left.
inline constexpr double largest_layer_angle_deg = 150;

/// Returns whether a background mesh decides on the sizes beyond the layers (SizedMesh::gradation).
inline bool decides_on_sizes(const SizingOptions& sizing) { return sizing.background && sizing.background->gradation; }

/// Returns border_options() for the spacings of the walls below the border, which grow no more slowly than sizes near bodies
/// should.
BorderOptions wall_border_options(const CaseOptions& options, double chord, std::span<const SizeSource> sources);

/// Makes rays on prepared walls. Behind the layers that go on along a wake, its sources request sizes. Throws OptionError
/// where layers do not fit into the far field.
RayPlan plan_rays(Geometry geometry, const ReferenceConditions& conditions, const CaseOptions& options,
                  const LayerGrowth& growth, std::vector<ElementWake> wakes = {});

/// Prepares the walls anew, from the given geometry, with a finer spacing where the layer's border would be divided,
/// and makes rays on them. Rows of cells would end in fans below division points (docs/decisions/0009).
void refine_walls_below_borders(const Geometry& given, const CaseOptions& options, SpacingLimits limits,
                                const LayerGrowth& growth, RayPlan& plan);

/// Shortens rays so that columns end below cells with an angle above 150 degrees, for as long as there are fewer and fewer of
/// them, first below those far from the wall. First layers stay (docs/layer.md).
void end_columns_below_obtuse_cells(const CaseOptions& options, RayPlan& plan);

/// If there are isotropic triangles whose angle is below the bound, and which no sharp corner excuses: shortens the
/// rays that end beside them (`thin`), or, where no layer is left and elsewhere, the edges of the borders there. Returns
/// whether it changed the plan.
bool make_room_at_narrow_triangles(std::span<const mesh::NarrowTriangle> narrow, bool thin, const CaseOptions& options,
                                   RayPlan& plan);

}  // namespace lamina::pipeline
