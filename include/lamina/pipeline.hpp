// The reading order of the whole program: airfoil in, viscous mesh out.
//
//   read_geometry   geometry.hpp     files, NACA names          -> Pslg
//   prepare_surfaces surface.hpp     kept, resampled, smoothed  -> Pslg
//   make_layer      layers.hpp       rays, points, outer border -> Layer
//   fill_layer      (pipeline.cpp)   Delaunay, or the grid      -> layer triangles, quads
//   SizeField       sizing.hpp       layer border lengths       -> h(x)
//   decouple        decoupling.hpp   near body, rings           -> Subdomains
//   refine          decoupling.hpp   one Subdomain              -> Refinement, all of them in parallel
//   assemble        (pipeline.cpp)   numbering, markers         -> Mesh
//   check_mesh      mesh.hpp         before anything is written
//   write_mesh      io.hpp
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>
#include <lamina/mesh.hpp>
#include <lamina/surface.hpp>

namespace lamina {

/// A line of size sources from each trailing edge (ElementSummary::trailing_edge), up to the first wall in its way.
/// Along it sizes grow by a tenth of the gradation.
struct WakeOptions {
    double angle_deg = 0;             ///< to the x axis
    double length = 2;                ///< in chords (extents in x of the whole configuration)
    std::optional<double> size = {};  ///< at the trailing edge; empty = what the layer's border has there
};

/// The flow that the first height is made for.
struct YPlusOptions {
    double y_plus = 1;                 ///< of the first layer's top
    double reynolds = 0;               ///< based on the chord
    std::optional<double> chord = {};  ///< in units of the input; empty = extent in x of the whole configuration
};

/// Everything that decides a mesh. Defaults are those of the command line.
struct CaseOptions {
    GeometryOptions geometry;
    SurfaceOptions surface;  ///< max_turning_deg is an upper bound: the layer's largest ray angle goes over it
    LayerOptions layer;
    std::optional<YPlusOptions> y_plus;  ///< goes over layer.first_height (first_height_for)
    double far_field = 100;              ///< half-width of the far-field box or radius of the circle, chords
    FarFieldShape far_field_shape = FarFieldShape::box;
    std::vector<Point> far_field_outline;  ///< for FarFieldShape::convex
    double gradation = 0.1;                ///< growth of the target edge length per unit of distance (docs/decisions)
    std::optional<double>
        wall_size;                   ///< longest target edge length at the layer's outer border: its edges ask for less
    std::optional<double> far_size;  ///< cap of the target edge length
    std::optional<WakeOptions> wake;
    std::vector<SizeSource> size_sources;  ///< boxes, discs and lines of the user's own
    /// Sizes of the user's own, too: nowhere in a triangle does the target edge length exceed the linear interpolation
    /// by more than a tenth, and the size field's relative error.
    std::shared_ptr<const SizedMesh> background;
    double min_angle_deg = 20.7;
    SeparatorRule separators = SeparatorRule::equidistributed;
    double pieces_target = 50'000;
    DecompositionOptions decomposition;  ///< of the layer
    unsigned threads = 0;                ///< 0 = all cores; never changes the mesh
};

/// Wall-clock seconds of each stage. Decomposition and triangulation of the layer and refinement run at the same time:
/// their common time is divided among them as the threads' time is.
struct StageSeconds {
    double geometry = 0, layers = 0, decomposition = 0, layer_triangulation = 0, sizing = 0, decoupling = 0,
           refinement = 0, assembly = 0, check = 0, total = 0;
};

/// What a thread did in the common time of these stages, in seconds.
struct ThreadSeconds {
    double decomposition = 0, layer_triangulation = 0, refinement = 0, idle = 0;
};

struct MeshResult {
    Mesh mesh;
    MeshCheck check;
    Pslg pslg;
    StageSeconds seconds;
    std::vector<ThreadSeconds> thread_seconds;
    unsigned threads = 1;
    std::size_t layer_pieces = 0, inviscid_pieces = 0;
    DecompositionStats decomposition;        ///< of the layer
    std::size_t largest_inviscid_piece = 0;  ///< triangles
    double estimates_within_15_percent = 1;  ///< share of the inviscid pieces whose load was foreseen so well
    std::size_t surface_vertices = 0;
    double first_height = 0;                      ///< of the layers; 0 without
    std::optional<YPlusOptions> y_plus;           ///< where the first height was made for it, with the chord in force
    std::vector<ElementCoverage> layer_coverage;  ///< per element; empty without layers
    RefineStats refinement;                       ///< summed over pieces
};

/// The options with what follows from the outlines filled in: the chord of y_plus and the layer's first height.
CaseOptions options_in_force(const Pslg& pslg, CaseOptions options);

/// The surface stage's options in force: turning bounded by the angle between the layer's rays, too.
SurfaceOptions surface_options(const CaseOptions& options);

/// Called at the start of each stage with its name; may be empty.
using Progress = std::function<void(const std::string& stage)>;

/// Runs every stage on a Pslg. Throws UsageError, InputError, MeshError; a mesh that is not valid is never returned.
MeshResult generate_mesh(Pslg pslg, const CaseOptions& options = {}, const Progress& progress = {});

/// Reads the inputs first.
MeshResult generate_mesh(const std::vector<std::string>& inputs, const CaseOptions& options = {},
                         const Progress& progress = {});

}  // namespace lamina
