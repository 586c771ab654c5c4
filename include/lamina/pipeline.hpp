// Stage "assemble", and all stages in their order: airfoils in, viscous mesh out. Each stage is a free function from
// values to a value and can be called by itself.
//
//   read              geometry.hpp     read_geometry      files, NACA names            -> Geometry
//   solve the flow    flow.hpp         solve_flow         if CaseOptions::use_flow     -> Flow
//   prepare           surface.hpp      prepare_surfaces   kept, resampled or smoothed  -> Geometry
//   make the layer    layers.hpp       make_layer         rays, heights, outer border  -> Layer
//   size              sizing.hpp       make_size_field    border lengths, sources      -> SizeField h(x)
//   decouple          decoupling.hpp   decouple           separators                   -> Decoupling, its Subdomains
//   fill the layer    layers.hpp       fill_layer         Delaunay, or the grid        -> LayerCells
//   refine            decoupling.hpp   refine             every Subdomain by itself    -> Refinements
//   check             mesh.hpp         check_mesh         piece by piece as refined    -> MeshCheck
//   assemble          this header      assemble           numbers, markers             -> Mesh
//   write             io.hpp           write_mesh
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/compressible_flow.hpp>
#include <lamina/conditions.hpp>
#include <lamina/decoupling.hpp>
#include <lamina/export.hpp>
#include <lamina/flow.hpp>
#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>
#include <lamina/limits.hpp>
#include <lamina/mesh.hpp>
#include <lamina/sizing.hpp>
#include <lamina/surface.hpp>
#include <lamina/warning.hpp>

namespace lamina {

/// Options of assemble().
struct AssembleOptions {
    bool base_marker = false;  ///< gives the base of a blunt trailing edge a marker of its own, NAME_base
};

/// The options of all stages, with the defaults of the command line. Together with the inputs they determine the mesh.
struct CaseOptions {
    GeometryOptions geometry{};            ///< read_geometry()
    FlowConditions conditions{};           ///< reference_conditions(): the chord that lengths count, and y+
    SurfaceOptions surface{};              ///< prepare_surfaces()
    LayerOptions layer{};                  ///< make_layer(), fill_layer()
    SizingOptions sizing{};                ///< gather_size_requests(), make_size_field()
    FarFieldOptions far_field{};           ///< place_far_field()
    DecouplingOptions decoupling{};        ///< decouple()
    DecompositionOptions decomposition{};  ///< fill_layer(): the pieces of the layer
    RefineOptions refine{};                ///< refine()
    AssembleOptions assemble{};            ///< assemble()
    /// Whether the flow before the mesh decides: first heights given by y+, the least thickness of layers up to
    /// isotropy, and wakes beside those of SizingOptions. Needs a Reynolds number.
    bool use_flow = false;
    /// Divides the lengths that no option holds: spacings and wakes that the flow decides on, slowest growth along
    /// walls, numbers of layers up to least heights. One of what refined() changes.
    double fineness = 1;
    bool inlet_outlet = false;  ///< whether the far field is two markers: split_far_field()
    WorkLimits limits{};        ///< generate_mesh() refuses what is beyond them, before the work
    unsigned threads = 0;       ///< number of threads; 0: one per core. Never changes the mesh
};

/// Throws OptionError where an option of any stage is out of range, where a y+ or the use of the flow lacks its Reynolds
/// number, and where the flow is to cross the slip walls of a tunnel or the ground.
LAMINA_EXPORT void validate(const CaseOptions& options);

/// Returns the options of a mesh that is similar to that of these options, with all lengths divided by `ratio`; below 1
/// the mesh is coarser. Members of a family for a study of convergence are made so.
///
/// Edges of walls, sizes, angles between rays, gradations and the changes of the flow from vertex to vertex are divided
/// by the ratio, and ratios of lengths r become r^(1/ratio). Layers keep their total height and their law: a given
/// number N becomes n, the whole number next to ratio x N, and heights as a function of the layer's number over N stay
/// the same. With ratio 2 and geometric growth two new layers lie in one old one: the growth is the root of the old
/// one, and the first height is the old one / (1 + root). Layers up to isotropy follow the same formulas with N / n = 1
/// / ratio. Exponential growth keeps its thickness; adaptive growth takes LayerOptions::growth for that of its rays. A
/// y+ is multiplied as the first height is. The geometry, the smallest angle, the far field and the flow stay.
/// SurfaceTreatment::automatic becomes resample, since points that were kept would not follow; the members of a family,
/// that of ratio 1 included, then have the same splines as walls. `conditions` are those of the geometry.
///
/// Throws OptionError where points are to be kept, for growth `aflr`, whose ratios are fixed, where the ratio is not
/// positive, and where the new options are out of range.
LAMINA_EXPORT CaseOptions refined(const CaseOptions& options, double ratio, const ReferenceConditions& conditions = {});

/// Returns the limits that the layer over the walls sets on their spacing: an argument of prepare_surfaces().
LAMINA_EXPORT SpacingLimits spacing_limits(const CaseOptions& options, const LayerGrowth& growth);

/// Returns the options by which the outer border of the layer is divided to suit sizes and refinement: an argument of
/// make_layer(). `chord` is the reference chord.
LAMINA_EXPORT BorderOptions border_options(const CaseOptions& options, double chord,
                                           std::span<const SizeSource> sources);

/// Returns the bodies in the form that the sizing stage takes.
LAMINA_EXPORT SizedBodies sized_bodies(const Geometry& geometry, const ReferenceConditions& conditions);

/// Joins the layer and the refined subdomains to one mesh, without any search by coordinates. Vertices keep the numbers
/// of the decoupling (walls, layer, separators); Steiner points follow, subdomain by subdomain. The triangles of the
/// layer come first, then those of the subdomains, then the quadrilaterals of the layer. Pieces are numbered in the
/// same order. Throws MeshError from 2^32 vertices on.
LAMINA_EXPORT Mesh assemble(const Geometry& geometry, const Layer& layer, LayerCells cells, Decoupling decoupling,
                            std::vector<Refinement> refinements, const AssembleOptions& options = {});

/// Divides the markers that are far fields into `inlet`, where a uniform flow at this angle enters, and `outlet`, the
/// rest. Either is left out where it has no edge. Throws OptionError where another marker has
/// one of these names.
LAMINA_EXPORT void split_far_field(Mesh& mesh, double alpha_deg);

/// Takes the edges on slip walls out of the markers that are far fields, and gives them the markers `ground` (the floor
/// where `has_ground`) and `tunnel`, of the kind symmetry. Throws OptionError where a marker has one of these names.
LAMINA_EXPORT void mark_slip_walls(Mesh& mesh, const FarField& far_field, bool has_ground);

/// Wall-clock seconds of the stages. The decomposition and triangulation of the layer, the refinement and the check of
/// its pieces run at the same time: their common time is divided among them in proportion to the time of the threads.
struct StageSeconds {
    double flow = 0;                 ///< the flow before the mesh
    double geometry = 0;             ///< read, prepare
    double layers = 0;               ///< grow rays, close the border
    double decomposition = 0;        ///< fill the layer: division into pieces
    double layer_triangulation = 0;  ///< fill the layer: the pieces
    double sizing = 0;               ///< size
    double decoupling = 0;           ///< decouple
    double refinement = 0;           ///< refine
    double assembly = 0;             ///< summaries and warnings; pieces are put together while others are refined
    double check = 0;                ///< check
    double total = 0;                ///< the whole run
};

/// The seconds that one thread spent on each kind of work in the time that all of them share.
struct ThreadSeconds {
    double decomposition = 0;        ///< dividing the layer into pieces
    double layer_triangulation = 0;  ///< triangulating the pieces
    double refinement = 0;           ///< refining subdomains
    double check = 0;                ///< checking them
    double idle = 0;                 ///< waiting
};

/// A wake that sizes follow for the flow's sake. Lengths are in units of the input.
struct FlowWake {
    std::string element;     ///< the one that it leaves
    double length = 0;       ///< along the streamline; less than asked for where it ends at another element
    double first_width = 0;  ///< at the trailing edge
    double last_width = 0;   ///< at its end
    double with_layers = 0;  ///< the length over which layers go on along it (LayerOptions::wake_layers)
    /// Whether it is the envelope of two shear layers with fluid at rest between them, along the free stream, from where the
    /// first one leaves the wall on.
    bool separated = false;
};

/// The smallest spacing that the flow asks for on the wall of one element.
struct FlowSpacing {
    std::string element;  ///< its name
    double smallest = 0;  ///< in units of the input
    Point at{};           ///< where
};

/// A shock for which the mesh is made finer.
struct FlowShock {
    std::string element;     ///< the one on which it stands
    Point at{};              ///< where it is expected on the wall
    bool has_layers = true;  ///< whether the flow that says so had boundary layers; else it is moved forward by a guess
    double mach_ahead = 0;   ///< largest Mach number of the wall ahead of it
    double height = 0;       ///< how far the shock reaches away from there, in units of the input
};

/// The decisions that the flow before the mesh made, beside first heights.
struct FlowDecisions {
    /// The largest of the heights that layers reach at least, in units of the input; 0 where the flow decides on none.
    double least_thickness = 0;
    std::vector<FlowWake> wakes;        ///< behind each element that has one
    std::vector<FlowSpacing> spacings;  ///< of each element whose wall was resampled, if the flow asks for any there
    std::vector<FlowShock> shocks;      ///< beyond the critical Mach number
    bool knows_shocks = false;  ///< whether compressible flow before the mesh became steady, and said where they are
};

/// A mesh, and the facts about it that the report of a run tells.
struct MeshResult {
    Mesh mesh;                                  ///< always valid
    MeshCheck check;                            ///< result of the last stage
    Geometry geometry;                          ///< the bodies with the vertices of their walls
    StageSeconds seconds;                       ///< times of the stages
    std::vector<ThreadSeconds> thread_seconds;  ///< per thread
    unsigned threads = 1;                       ///< number of threads used
    std::size_t layer_pieces = 0;               ///< pieces that the layer was triangulated in
    std::size_t inviscid_pieces = 0;            ///< subdomains outside the layer
    DecompositionStats decomposition;           ///< of the layer
    bool layer_grid_refused = false;            ///< as in LayerCells
    std::size_t largest_inviscid_piece = 0;     ///< triangles of the largest subdomain
    double estimates_within_15_percent = 1;     ///< share of the subdomains whose estimate was within 15 % of the truth
    std::size_t surface_vertices = 0;           ///< vertices of the walls
    std::vector<double> first_heights;          ///< of the layers, one per element; empty without layers
    std::optional<YPlus> y_plus;                ///< what the first heights follow from; empty: they were given
    ReferenceConditions conditions;             ///< the chord that lengths count, and the flow
    std::optional<Flow> flow;                   ///< what decided with CaseOptions::use_flow
    FlowDecisions decisions;                    ///< what it decided
    /// The columns of the cells of the layer (LayerCells::triangle_column), first of its triangles, which come first in
    /// the mesh, then of the quads. Empty for Delaunay layers and without layers.
    std::vector<std::uint32_t> columns;
    std::vector<VertexId> column_origins;         ///< per column: the vertex that its first ray begins at
    std::vector<ElementCoverage> layer_coverage;  ///< per element; empty without layers
    BorderSteps border_steps;                     ///< of the layer's outer border
    std::size_t thinned_rays = 0;                 ///< rays shortened so that angles beyond and within keep bounds
    Point thinned_at{};                           ///< origin of the one that lost the largest share of its height
    RefineStats refinement;                       ///< summed over the subdomains
    double mean_edge_over_size = 0;               ///< mean isotropic edge over h at its middle, of a sample; 0: no edge
    RunEstimate estimate;                         ///< made before the work
    std::vector<Warning> warnings;                ///< what the user should know about the mesh; empty: nothing
};

/// A message of a run that goes on.
struct ProgressEvent {
    std::string stage;                      ///< the name of the stage that begins
    std::optional<RunEstimate> estimate{};  ///< given once, when the work that takes the time first begins
};

/// A function that is called when a stage begins. It may be empty.
using Progress = std::function<void(const ProgressEvent&)>;

/// Runs all stages on bodies in memory. Never returns a mesh that is not valid. Throws OptionError, InputError and
/// MeshError, and LimitError in the first second or two where the run would exceed options.limits by estimate.
/// Precondition: check_simple(geometry).
LAMINA_EXPORT MeshResult generate_mesh(const Geometry& geometry, const CaseOptions& options = {},
                                       const Progress& progress = {});

/// Reads the inputs and runs all stages on them. Throws IoError, too.
LAMINA_EXPORT MeshResult generate_mesh(const std::vector<std::string>& inputs, const CaseOptions& options = {},
                                       const Progress& progress = {});

/// Flow that is faster than sound along fewer chords of the walls than this, as at peaks beside lips and noses, counts as
/// subsonic.
inline constexpr double longest_peak = 0.05;

/// Returns whether the flow round these bodies is expected to be faster than sound at the Mach number of the conditions:
/// from Mach 1 on, and where supersonic_length() of incompressible `flow` is above longest_peak. False without a Mach
/// number.
LAMINA_EXPORT bool is_beyond_critical(const Flow& flow, const FlowConditions& conditions);

/// Returns the steady compressible flow at the Mach number of the conditions. Makes a mesh without layers of some 9,000
/// triangles and more per element, and solves the Euler equations on it. Where a Reynolds number of at least 1e4 is given
/// and the free stream is subsonic, turbulent boundary layers and wakes displace the flow (Green's lag entrainment,
/// quasi-simultaneously after Veldman); where that does not become steady, the flow is one without them. Does not depend on
/// the number of threads. Where the flow does not become steady at all, CompressibleFlow::converged is false, and the numbers
/// are those of the last step.
///
/// On RAE 2822 at Mach 0.729, 0.734 and 0.75 lift is within 1.3 % of that of the Reynolds-averaged equations (SA), drag
/// within 10 %, and shocks are within 2 % of the chord. Without boundary layers shocks lie too far back, by 6 to 9 % of the
/// chord, and there is too much lift.
///
/// Precondition: check_simple(geometry). Throws OptionError for conditions out of range and without a Mach number, and
/// what generate_mesh() throws.
LAMINA_EXPORT CompressibleFlow solve_compressible_flow(const Geometry& geometry, const FlowConditions& conditions);

}  // namespace lamina
