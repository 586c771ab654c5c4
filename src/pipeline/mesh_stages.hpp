// The stages from the layer's border to the check and the warnings.
#pragma once

#include <memory>
#include <vector>

#include <lamina/pipeline.hpp>

#include "mesh/piece_check.hpp"
#include "mesh/shared_parts.hpp"
#include "pipeline/fit_layer.hpp"
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

/// Makes a mesh round this layer. Throws MeshError where it is not valid, and LimitError.
MadeMesh make_mesh(const FittedLayer& fitted, const CaseOptions& options, MeshDriver& driver, StageClock& clock);

}  // namespace lamina::pipeline
