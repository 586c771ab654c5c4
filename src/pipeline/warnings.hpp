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
};

/// Returns the warnings about a result that is complete but for them. The mesh `layer` holds the cells of the layer, and
/// perhaps others.
std::vector<Warning> find_warnings(const MeshResult& result, const CaseOptions& options, const WorstPlaces& worst,
                                   const Mesh& layer);

}  // namespace lamina::pipeline
