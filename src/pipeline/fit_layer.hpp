// The layer is fitted to the walls, to the room between them, and to what is beyond it.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <lamina/pipeline.hpp>

#include "decoupling/far_field.hpp"
#include "layers/stages.hpp"
#include "mesh/piece_check.hpp"
#include "pipeline/flow_guidance.hpp"
#include "pipeline/internal_lines.hpp"
#include "pipeline/outer_walls.hpp"
#include "sizing/requests.hpp"
#include "surface/spacing_limits.hpp"
#include "surface/wall_curves.hpp"

namespace lamina::pipeline {

/// Walls as they are given and as they are prepared, with the limits on their spacing.
struct PreparedWalls {
    const Geometry& given;
    const SurfaceOptions& options;
    surface::SpacingLimits limits;
    surface::PreparedSurfaces prepared{};
};

/// The options of a layer, and how its cells grow.
struct LayerRequest {
    const LayerOptions& options;
    const DecompositionOptions& decomposition;  ///< of layers of LayerTopology::delaunay
    const layers::LayerGrowth& growth;          ///< that of the options, or of the flow
};

/// The far field round the bodies, and the lines inside it.
struct DomainRequest {
    const FarFieldOptions& far_field;
    std::span<const InternalLine> lines;
};

/// The sizes that edges beyond the layer follow: those asked for, those of wakes, and those of the border of the layer.
struct OuterSizes {
    SizingOptions options;             ///< with the sources that lines and shocks add to those given
    std::vector<ElementWake> wakes{};  ///< of the flow, one per element or none
    layers::BorderOptions border{};    ///< how the layer's border is divided, but for the sources of the requests
};

/// Rays on walls, of which close_border() makes the layer, and the sizes that their fronts and the options request.
struct FittedLayer {
    Geometry geometry;  ///< the walls below
    ReferenceConditions conditions;
    decoupling::FarField far_field;
    std::vector<OuterWallFacts> outer_walls;  ///< those of the far field
    layers::Rays rays;
    LineGraph lines{};                                    ///< those inside the domain
    std::shared_ptr<const surface::WallCurves> curves{};  ///< of the walls, for curved cells
    OuterSizes sizes{};
    sizing::SizeRequests requests{};
    std::vector<double> first_front{};      ///< of the rays, before any was shortened
    std::size_t thinned_rays = 0;           ///< MeshResult::thinned_rays
    Point thinned_at{};                     ///< MeshResult::thinned_at
    std::vector<Point> below{};             ///< border_below() in a row of blades
    std::vector<SizeSource> short_edges{};  ///< further sizes for the edges of borders
};

/// Prepares walls for a layer that sets these limits. `chord` is the reference chord.
PreparedWalls prepare_walls(const Geometry& given, const SurfaceOptions& options, surface::SpacingLimits limits,
                            double chord);

/// Makes rays on these walls. Walls become finer where the layer's border would be divided, and columns end below cells
/// with angles above 150 degrees. Behind the layers that go on along a wake, its sources request sizes. Throws
/// OptionError where layers do not fit into the far field.
FittedLayer fit_layer(PreparedWalls walls, const LayerRequest& layer, const DomainRequest& domain,
                      const OuterSizes& sizes, const ReferenceConditions& conditions);

/// Returns the layer on its rays.
layers::Layer close_border(const FittedLayer& fitted);

/// If there are isotropic triangles whose angle is below the bound, and which no sharp corner excuses: shortens the
/// rays that end beside them (`thin`), or, where no layer is left and elsewhere, the edges of the borders there.
/// Returns whether it changed anything.
bool make_room_at_narrow_triangles(std::span<const mesh::NarrowTriangle> narrow, bool thin, FittedLayer& fitted);

}  // namespace lamina::pipeline
