// The stages from the layer's border to the check of the mesh, in the order in which make_mesh() calls them.
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
    FeetInLayer feet;              ///< feet_in_layer()
    decoupling::InnerLines lines;  ///< inside the region

    /// Returns the region, which refers to this and to `fitted`.
    decoupling::OuterRegion outer(const FittedLayer& fitted, const DecouplingOptions& options) const;
};

/// Closes the border of the layer and of the region beyond it. What is known of the layer then goes to `result`.
OutlinedMesh outline_mesh(const FittedLayer& fitted, const LayerOptions& layer_options, const SurfaceOptions& surface,
                          StageClock& clock, MeshResult& result);

/// Returns all markers of the mesh. The far field of tunnels is divided into inlet and outlet, and others if the
/// options ask for it.
std::vector<Marker> markers_of_mesh(const FittedLayer& fitted, const OutlinedMesh& outlined,
                                    const AssembleOptions& options, const FarFieldOptions& domain,
                                    const DecoupledBorders& borders, MeshDriver& driver);

/// Returns what the check of the pieces has to know of the layer.
MeshCheckOptions options_of_check(const FittedLayer& fitted, const layers::Layer& layer, double min_angle_deg,
                                  const MeshResult& result, std::span<const Marker> markers);

/// Ends the check of the pieces. Throws MeshError where the mesh is not valid.
void finish_check(mesh::PiecewiseCheck& check, const MadePieces& pieces, std::span<const Marker> markers,
                  MadeMesh& made);

/// Moves the cells to the result, but for markers, with what is known of layer and refinement.
void take_cells(const layers::Layer& layer, MadePieces& pieces, MeshResult& result);

/// Closes sheets, doubles the vertices of two-sided lines, and checks the mesh as a whole, if there are any: pieces
/// know no lines, and sheets with a gap. Beside lines the summary of walls stays that of the pieces, since those with
/// two sides have no layers.
void complete_walls_without_thickness(std::span<const InternalLine> lines, double min_angle_deg, MadeMesh& made);

/// Gives what is left of the pieces, beside the mesh, to who asked for it.
void hand_over(MadePieces& pieces, MadeMesh& made);

}  // namespace lamina::pipeline
