// Search for properties of a valid mesh that its user probably does not want.
#pragma once

#include <span>
#include <vector>

#include <lamina/pipeline.hpp>

#include "mesh/piece_check.hpp"

namespace lamina::pipeline {

/// The worst isotropic triangles of a mesh.
struct WorstPlaces {
    Point widest, narrowest, oversized;                 ///< the middles of the first ones, where warnings need them
    std::span<const mesh::NarrowTriangle> unexcused{};  ///< below the bound on angles
    double min_angle_deg = 0;                           ///< that bound
};

/// Returns the warnings about bodies, their prepared walls and the flow.
std::vector<Warning> warnings_of_input(const MeshResult& result, const SurfaceOptions& surface,
                                       const FlowConditions& conditions, const AssembleOptions& markers);

/// Returns the warnings about the mesh of a result that is complete but for them. The mesh `layer` holds the cells of
/// the layer, and perhaps others.
std::vector<Warning> warnings_of_mesh(const MeshResult& result, const LayerOptions& options, const WorstPlaces& worst,
                                      const Mesh& layer);

}  // namespace lamina::pipeline
