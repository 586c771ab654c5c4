// The reading order of the whole program: airfoil in, viscous mesh out. Each stage is a free function from values to a
// value and can be called by itself.
//
//   read              geometry.hpp     read_geometry      files, NACA names            -> Geometry
//   prepare           surface.hpp      prepare_surfaces   kept, resampled or smoothed  -> Geometry
//   grow rays         layers.hpp       grow_rays          normals, fans, heights       -> Rays
//   close the border  layers.hpp       close_border       points, graded outer border  -> Layer
//   size              sizing.hpp       make_size_field    border lengths, sources      -> SizeField h(x)
//   decouple          decoupling.hpp   decouple           separators                   -> Decoupling, its Subdomains
//   fill the layer    layers.hpp       fill_layer         Delaunay, or the grid        -> LayerCells
//   refine            decoupling.hpp   refine             every Subdomain by itself    -> Refinements
//   assemble          this header      assemble           numbers, markers             -> Mesh
//   check             mesh.hpp         check_mesh         before anything is written   -> MeshCheck
//   write             io.hpp           write_mesh
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/export.hpp>
#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>
#include <lamina/mesh.hpp>
#include <lamina/option.hpp>
#include <lamina/sizing.hpp>
#include <lamina/surface.hpp>

namespace lamina {

struct AssembleOptions {
    bool base_marker = false;  ///< the base of a blunt trailing edge gets a marker of its own, NAME_base
};

/// Everything that decides a mesh: the options of the stages.
struct CaseOptions {
    GeometryOptions geometry;
    SurfaceOptions surface;
    LayerOptions layer;
    SizingOptions sizing;
    FarFieldOptions far_field;
    DecouplingOptions decoupling;
    DecompositionOptions decomposition;  ///< of the layer
    RefineOptions refine;
    AssembleOptions assemble;
    unsigned threads = 0;  ///< 0: one per core; never changes the mesh
};

/// Returns the table of all options. The defaults of CaseOptions are those of the command line.
LAMINA_EXPORT const OptionTable<CaseOptions>& case_option_table();

/// Throws OptionError where an option of any stage is out of range.
LAMINA_EXPORT void validate(const CaseOptions& options);

/// Returns what the layer over the walls asks of their spacing: the argument of prepare_surfaces().
LAMINA_EXPORT SpacingLimits spacing_limits(const CaseOptions& options, const LayerGrowth& growth);

/// Returns how the outer border of the layer is divided to suit sizes and refinement: the argument of close_border().
LAMINA_EXPORT BorderOptions border_options(const CaseOptions& options, std::span<const SizeSource> sources);

/// Returns the bodies as the sizing stage wants them.
LAMINA_EXPORT SizedBodies sized_bodies(const Geometry& geometry);

/// Joins layer and refined subdomains to one mesh, without any search by coordinates. Vertices keep the numbers of the
/// decoupling (walls, layer, separators); Steiner points follow, subdomain by subdomain. The triangles of the layer
/// come first, then those of the subdomains, then the quadrilaterals of the layer. Pieces are numbered likewise. Throws
/// MeshError from 2^32 vertices on.
LAMINA_EXPORT Mesh assemble(const Geometry& geometry, const Layer& layer, LayerCells cells, Decoupling decoupling,
                            std::vector<Refinement> refinements, const AssembleOptions& options = {});

/// Wall-clock seconds of each stage. Decomposition and triangulation of the layer and refinement run at the same time:
/// their common time is divided among them in proportion to the time of the threads.
struct StageSeconds {
    double geometry = 0, layers = 0, decomposition = 0, layer_triangulation = 0, sizing = 0, decoupling = 0,
           refinement = 0, assembly = 0, check = 0, total = 0;
};

/// What one thread did in the common time of these stages, in seconds.
struct ThreadSeconds {
    double decomposition = 0, layer_triangulation = 0, refinement = 0, idle = 0;
};

struct MeshResult {
    Mesh mesh;
    MeshCheck check;
    Geometry geometry;
    StageSeconds seconds;
    std::vector<ThreadSeconds> thread_seconds;
    unsigned threads = 1;
    std::size_t layer_pieces = 0, inviscid_pieces = 0;
    DecompositionStats decomposition;        ///< of the layer
    std::size_t largest_inviscid_piece = 0;  ///< in triangles
    double estimates_within_15_percent = 1;  ///< share of the subdomains whose number of triangles was foreseen so well
    std::size_t surface_vertices = 0;
    double first_height = 0;                      ///< of the layers; 0 without
    std::optional<YPlus> y_plus;                  ///< the flow that the first height follows from, with its chord
    std::vector<ElementCoverage> layer_coverage;  ///< per element; empty without layers
    RefineStats refinement;                       ///< summed over the subdomains
};

/// A function that is called at the start of each stage with its name; may be empty.
using Progress = std::function<void(const std::string& stage)>;

/// Runs every stage on bodies that are at hand. Throws OptionError, InputError, MeshError; never returns a mesh that is
/// not valid. Precondition: check_simple(geometry).
LAMINA_EXPORT MeshResult generate_mesh(Geometry geometry, const CaseOptions& options = {},
                                       const Progress& progress = {});

/// Reads the inputs and runs every stage. Throws IoError, too.
LAMINA_EXPORT MeshResult generate_mesh(const std::vector<std::string>& inputs, const CaseOptions& options = {},
                                       const Progress& progress = {});

}  // namespace lamina
