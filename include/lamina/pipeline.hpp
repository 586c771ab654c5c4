// All stages in their order: airfoils in, viscous mesh out. docs/architecture.md shows them; those before and after the
// layer can be called by themselves: read_geometry(), solve_flow(), prepare_surfaces(), check_mesh(), write_mesh().
//
// Guarantees:
//  1. A mesh that is returned is valid: check_mesh() would find no defect.
//  2. Inputs and options determine the mesh, bit for bit, on any number of threads.
//  3. A run that would exceed CaseOptions::limits ends with a LimitError in the first second or two, by estimate.
// Limits:
//  1. Angles, sizes and first heights are kept where geometry and options let them: MeshResult::warnings say more.
//  2. OptionError, InputError, IoError and MeshError, as the stages throw them.
// Example:
//     CaseOptions options;
//     options.layer = {.first_height = 1e-3, .layers = 8};  // chords
//     options.far_field.size = 10;
//     const MeshResult result = generate_mesh({"naca:0012"}, options);
//     assert(result.check.valid() && result.first_heights[0] == 1e-3);
//     assert(result.check.isotropic.unexcused() == 0 && result.mesh.markers[0].name == "airfoil");
#pragma once

#include <lamina/compressible_flow.hpp>
#include <lamina/curved_mesh.hpp>
#include <lamina/decoupling.hpp>
#include <lamina/delaunay.hpp>
#include <lamina/flow.hpp>
#include <lamina/layers.hpp>
#include <lamina/limits.hpp>
#include <lamina/mesh.hpp>
#include <lamina/surface.hpp>

namespace lamina {

/// Options of the markers.
struct AssembleOptions {
    bool base_marker = false;  ///< gives the base of a blunt trailing edge a marker of its own, NAME_base
    /// Whether the far field is two markers: `inlet`, where a uniform flow at the angle of attack enters, and `outlet`.
    bool inlet_outlet = false;
};

/// A line inside the domain that becomes edges of the mesh with a marker of its own: a rake, a sensor, an actuator
/// disc, a baffle. It may cross other lines and bodies, inside which it ends, and layers give way to it.
struct InternalLine {
    std::string name;             ///< of its marker
    std::vector<Point> points{};  ///< at least two, in units of the input
    /// Whether it is a wall without thickness, with vertices on both sides, rather than edges between cells.
    bool two_sided = false;
    std::optional<double> size{};  ///< requested edge length along it, in units of the input
    std::string file{};            ///< that the points come from; empty where they are given by themselves
};

/// The options of all stages, with the defaults of the command line.
struct CaseOptions {
    GeometryOptions geometry{};            ///< read_geometry()
    FlowConditions conditions{};           ///< reference_conditions(): the chord that lengths count, and y+
    SurfaceOptions surface{};              ///< prepare_surfaces()
    LayerOptions layer{};                  ///< the layer
    SizingOptions sizing{};                ///< the sizes beyond the layer
    FarFieldOptions far_field{};           ///< the outer boundary
    DecouplingOptions decoupling{};        ///< the subdomains of the outer region
    DecompositionOptions decomposition{};  ///< the pieces of layers of LayerTopology::delaunay
    RefineOptions refine{};                ///< the triangles beyond the layer
    AssembleOptions assemble{};            ///< the markers
    /// Whether the flow before the mesh decides: first heights given by y+, the least thickness of layers up to
    /// isotropy, and wakes beside those of SizingOptions. Needs a Reynolds number.
    bool use_flow = false;
    /// Divides the lengths that no option holds: spacings and wakes that the flow decides on, slowest growth along
    /// walls, numbers of layers up to least heights. One of what refined() changes.
    double fineness = 1;
    /// How many vertices or cells the mesh is to have, within 3 %: with_scale() then divides the lengths of the
    /// options. At most one of both is given.
    std::optional<std::size_t> vertices{};
    std::optional<std::size_t> cells{};  ///< as vertices
    std::vector<InternalLine> lines{};   ///< lines inside the domain
    /// The order of the cells: 1 makes straight ones, and up to max_cell_order curved ones that follow the walls
    /// (MeshResult::curved). Needs layers of topology quads or layered, or none; excludes sheets and rows of blades.
    unsigned order = 1;
    NodeDistribution node_distribution = NodeDistribution::equidistant;  ///< where the nodes of curved cells are
    WorkLimits limits{};                                                 ///< runs beyond them are refused
    unsigned threads = 0;                                                ///< number of threads; 0: one per core
};

/// Throws OptionError where an option of any stage is out of range, where a y+ or the use of the flow lacks its
/// Reynolds number, and where the flow is to cross the walls of a tunnel or the ground.
LAMINA_EXPORT void validate(const CaseOptions& options);
/// Returns ground and tunnel walls, or the row, of the domain round this geometry, as solve_flow() takes them. Throws
/// OptionError where the flow is to cross them.
LAMINA_EXPORT FlowWalls flow_walls(const Geometry& geometry, const FlowConditions& conditions,
                                   const FarFieldOptions& domain);
/// Returns the options of a mesh that is similar to that of these options, with all lengths divided by `ratio`; below 1
/// the mesh is coarser. Members of a family for a study of convergence are made so.
///
/// Edges of walls, sizes, angles between rays, gradations and the changes of the flow from vertex to vertex are divided
/// by the ratio, and ratios of lengths r become r^(1/ratio). Layers keep their total height and their law: a given
/// number N becomes n, the whole number next to ratio x N, and heights as a function of the layer's number over N stay
/// the same. With ratio 2 and geometric growth two new layers lie in one old one: the growth is the root of the old
/// one, and the first height is the old one / (1 + root). Layers up to isotropy follow with N / n = 1 / ratio. Adaptive
/// growth takes LayerOptions::growth for that of its rays. A y+ is multiplied as the first height is. Geometry,
/// smallest angle, far field and flow stay. SurfaceTreatment::automatic becomes resample, since points that were kept
/// would not follow; members of a family, that of ratio 1 included, then have the same splines as walls.
///
/// `conditions` are those of the geometry. Throws OptionError where points are to be kept, for growth `aflr`, whose
/// ratios are fixed, where the ratio is not positive, and where the new options are out of range.
LAMINA_EXPORT CaseOptions refined(const CaseOptions& options, double ratio, const ReferenceConditions& conditions = {});
/// Returns the options of a mesh of the same first heights that is finer by `scale` elsewhere; below 1 it is coarser.
/// All of refined() holds, but for layers: the growth r of those up to isotropy becomes r^(1/scale), and a given number
/// stays as it is. CaseOptions::vertices and cells are left out. Throws OptionError where points are to be kept, and
/// for a scale that is not positive.
LAMINA_EXPORT CaseOptions with_scale(const CaseOptions& options, double scale);
/// Returns the bodies with the walls that generate_mesh() begins with: prepare_surfaces() with spacings for the layer.
LAMINA_EXPORT Geometry prepare_geometry(Geometry geometry, const CaseOptions& options);

/// Wall-clock seconds of the stages. Decomposition and triangulation of the layer, refinement and check run at the same
/// time: their common time is divided among them in proportion to the time of the threads.
struct StageSeconds {
    double flow = 0;                 ///< the flow before the mesh
    double geometry = 0;             ///< reading, walls
    double layers = 0;               ///< rays, outer border of the layer
    double decomposition = 0;        ///< dividing the layer into pieces
    double layer_triangulation = 0;  ///< the pieces of the layer
    double sizing = 0;               ///< sizes
    double decoupling = 0;           ///< subdomains
    double refinement = 0;           ///< triangles of the subdomains
    double assembly = 0;             ///< summaries and warnings; pieces are put together while others are refined
    double check = 0;                ///< the check
    double curving = 0;              ///< curved cells and their proof
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
    /// Whether it is the envelope of two shear layers with fluid at rest between them, along the free stream, from
    /// where the first one leaves the wall on.
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

/// What the flow at one of several angles of attack would ask for alone. Lengths are in units of the input.
struct AngleDecisions {
    double alpha_deg = 0;         ///< the angle
    double lift = 0;              ///< lift coefficient of the flow
    double first_height = 0;      ///< smallest of the first heights for the y+; 0: a height was given
    double least_thickness = 0;   ///< FlowDecisions::least_thickness
    double smallest_spacing = 0;  ///< smallest spacing of walls; 0: none
    bool separated = false;       ///< whether the flow is stalled or bluff: WarningCode::flow_separates
};

/// The decisions that the flow before the mesh made, beside first heights.
struct FlowDecisions {
    double least_thickness = 0;   ///< largest of the heights that layers reach at least, in units of the input; 0: none
    std::vector<FlowWake> wakes;  ///< behind each element that has one
    std::vector<FlowSpacing> spacings;  ///< of each element whose wall was resampled, if the flow asks for any there
    std::vector<FlowShock> shocks;      ///< beyond the critical Mach number
    bool knows_shocks = false;  ///< whether compressible flow before the mesh became steady, and said where they are
    /// Per element the largest skin friction times the wall's density, both by the free stream, where compressible flow
    /// with boundary layers was found: first heights for a y+ follow from these. Else empty.
    std::vector<double> frictions{};
    std::vector<AngleDecisions> angles{};  ///< of FlowConditions::alphas; empty: the mesh is for one angle
};

/// The layers on a wall of the domain.
struct OuterWallLayer {
    std::string name;          ///< of its marker: `ground`, `floor` or `ceiling`
    double first_height = 0;   ///< in units of the input
    ElementCoverage coverage;  ///< how many of the cells were made
};

/// A mesh, and the facts about it that the report of a run tells.
struct MeshResult {
    Mesh mesh;                                  ///< the mesh
    MeshCheck check;                            ///< result of its check
    Geometry geometry;                          ///< the bodies with the vertices of their walls
    StageSeconds seconds;                       ///< times of the stages
    std::vector<ThreadSeconds> thread_seconds;  ///< per thread
    unsigned threads = 1;                       ///< number of threads used
    std::size_t layer_pieces = 0;               ///< pieces that the layer was triangulated in
    std::size_t inviscid_pieces = 0;            ///< subdomains outside the layer
    DecompositionStats decomposition;           ///< of the layer
    bool layer_grid_refused = false;            ///< whether cells of a grid would have crossed: they are Delaunay
    std::size_t largest_inviscid_piece = 0;     ///< triangles of the largest subdomain
    double estimates_within_15_percent = 1;     ///< share of the subdomains whose estimate was within 15 % of the truth
    std::size_t surface_vertices = 0;           ///< vertices of the walls
    std::vector<double> first_heights;          ///< of the layers, one per element; empty without layers
    std::optional<YPlus> y_plus;                ///< what the first heights follow from; empty: they were given
    ReferenceConditions conditions;             ///< the chord that lengths count, and the flow
    std::optional<Flow> flow;                   ///< what decided with CaseOptions::use_flow
    std::optional<CompressibleFlow> compressible_flow;  ///< what decided with it beyond the critical Mach number
    FlowDecisions decisions;                            ///< what it decided
    /// The columns (between two neighbouring rays) of the cells of the layer, first of its triangles, which come first
    /// in the mesh, then of the quads. Empty for Delaunay layers and without layers.
    std::vector<std::uint32_t> columns;
    CurvedNodes curved;                    ///< with CaseOptions::order above 1: what makes the cells of the mesh curved
    CurvingSummary curving;                ///< how well they follow the walls
    CurvedCheck curved_check;              ///< the proof that they are valid
    std::vector<VertexId> column_origins;  ///< per column: the vertex that its first ray begins at
    std::vector<ElementCoverage> layer_coverage;  ///< per element; empty without layers
    std::vector<OuterWallLayer> outer_walls;      ///< ground, floor and ceiling that have layers
    BorderSteps border_steps;                     ///< of the layer's outer border
    std::size_t thinned_rays = 0;                 ///< rays shortened so that angles beyond and within keep bounds
    Point thinned_at{};                           ///< origin of the one that lost the largest share of its height
    RefineStats refinement;                       ///< summed over the subdomains
    double scale = 1;                             ///< that with_scale() had for CaseOptions::vertices or cells
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
/// Runs all stages on bodies in memory. Precondition: check_simple(geometry).
LAMINA_EXPORT MeshResult generate_mesh(const Geometry& geometry, const CaseOptions& options = {},
                                       const Progress& progress = {});
/// Reads the inputs and runs all stages on them.
LAMINA_EXPORT MeshResult generate_mesh(const std::vector<std::string>& inputs, const CaseOptions& options = {},
                                       const Progress& progress = {});

/// A mesh, and the scale that it was made with.
struct ScaledMesh {
    double scale = 1;   ///< as make() got it
    MeshResult result;  ///< as make() returned it
    double count = 0;   ///< as count() returned it
};

/// Makes meshes of different scales until one has so many vertices, or whatever `count` counts, within 3 %; eight at
/// most. Returns the nearest. Scales for which make() throws OptionError, LimitError included, are taken for too large
/// above 1 and too small below; that of scale 1 is passed on. Precondition: counts grow with the scale.
LAMINA_EXPORT ScaledMesh mesh_of_count(double wanted, const std::function<MeshResult(double scale)>& make,
                                       const std::function<double(const MeshResult&)>& count);

/// Returns whether the flow round these bodies is expected to be faster than sound at the Mach number of the
/// conditions: from Mach 1 on, and where the incompressible `flow` is, with_compressed_pressures(), along more than
/// 0.05 chords of the walls, since peaks beside lips and noses do not count. False without a Mach number.
LAMINA_EXPORT bool is_beyond_critical(const Flow& flow, const FlowConditions& conditions);

/// Returns the steady compressible flow at the Mach number of the conditions: solves the Euler equations on a mesh
/// without layers of some 9,000 triangles and more per element. Where a Reynolds number of at least 1e4 is given and
/// the free stream is subsonic, turbulent boundary layers and wakes displace the flow (Green's lag entrainment, solved
/// together with the flow's answer after Veldman). Precondition: check_simple(geometry). Throws OptionError for
/// conditions out of range and without a Mach number, and what generate_mesh() throws.
LAMINA_EXPORT CompressibleFlow solve_compressible_flow(const Geometry& geometry, const FlowConditions& conditions);

}  // namespace lamina
