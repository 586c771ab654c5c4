// The stages from the layer's border to the check and the warnings.
#pragma once

#include <memory>
#include <vector>

#include <lamina/pipeline.hpp>

#include "decoupling/subdomain.hpp"
#include "layers/layer.hpp"
#include "mesh/piece_check.hpp"
#include "mesh/shared_parts.hpp"
#include "pipeline/fit_layer.hpp"
#include "pipeline/outer_walls.hpp"
#include "pipeline/sharing/mesh_driver.hpp"
#include "pipeline/stage_clock.hpp"

namespace lamina::pipeline {

/// A mesh, and the triangles beyond its layer that miss the bound on angles without a sharp corner that excuses them.
struct MadeMesh {
    MeshResult result;  ///< its mesh has markers, and cells where the driver keeps them; no constraints
    std::vector<mesh::NarrowTriangle> narrow{};
    MeshCounts counts{};
    std::string hash{};  ///< where the driver knows it
    std::vector<Segment> constraints{};
    std::unique_ptr<MeshSink> sink{};
    std::shared_ptr<const mesh::MeshParts> parts{};
};

/// The layer and the region beyond it, with its sizes, before any cell is made.
struct OutlinedMesh {
    layers::Layer layer;
    SizeField size;
    RegionBorders region;
    decoupling::InnerLines lines;  ///< inside the region

    /// Returns the region, which refers to this and to `fitted`.
    decoupling::OuterRegion outer(const FittedLayer& fitted, const DecouplingOptions& options) const;
};

/// Closes the border of the layer and of the region beyond it. What is known of the layer then goes to `result`.
OutlinedMesh outline_mesh(const FittedLayer& fitted, const CaseOptions& options, StageClock& clock, MeshResult& result);

/// Makes a mesh round this layer. Throws MeshError where it is not valid, and LimitError.
MadeMesh make_mesh(const FittedLayer& fitted, const CaseOptions& options, MeshDriver& driver, StageClock& clock);

}  // namespace lamina::pipeline
