// The mesh, and the check that proves it valid and measures its quality.
//
// Guarantees:
//  1. A mesh in which check_mesh() finds no defect is valid: indices are in range; cells are counter-clockwise and have
//     positive area; it is conforming (each directed edge is used once); it covers its domain once (signed areas, Euler
//     characteristic, simple boundary loops, no vertex without cells, none that the boundary passes twice); each
//     boundary edge is in exactly one marker, and each edge of a marker on the boundary; those of internal markers have
//     cells on both sides. A wall without thickness is a marker of two rows of boundary edges at the same places, with
//     vertices of their own: such edges may coincide, and nothing else. The check is exact.
// Limits:
//  1. Delaunay property and quality are measured, not required. Functions besides check_mesh() need indices in range.
// Example:
//     Mesh mesh{.points = {{0, 0}, {1, 0}, {0, 1}}, .triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}}};
//     assert(!check_mesh(mesh).valid());  // its edges are in no marker
//     for (const std::size_t i : {0, 1, 2}) mesh.constraints.push_back({VertexId{i}, VertexId{(i + 1) % 3}});
//     mesh.markers.push_back({"box", MarkerKind::far_field, std::exchange(mesh.constraints, {})});
//     assert(check_mesh(mesh).valid() && check_mesh(mesh).area == 0.5);
#pragma once

#include <span>
#include <vector>

#include <lamina/angle_bounds.hpp>
#include <lamina/ids.hpp>
#include <lamina/marker_names.hpp>
#include <lamina/warning.hpp>

namespace lamina {

/// The part of the mesh that a cell belongs to.
enum class Region : std::uint8_t {
    layer,     ///< the anisotropic cells next to the walls
    isotropic  ///< all other cells
};

/// A named part of the boundary, or a line of edges inside the mesh.
struct Marker {
    std::string name;                     ///< unique in the mesh
    MarkerKind kind = MarkerKind::other;  ///< the boundary condition
    std::vector<Segment> edges;           ///< directed with the mesh on their left
};

/// A conforming mesh of triangles and quadrilaterals. The vertices of the walls come first, in the order of the input,
/// then those of the layer, then the rest. Arrays per cell are empty or hold one entry per cell, triangles first.
struct Mesh {
    std::vector<Point> points{};         ///< the vertices
    std::vector<Triangle> triangles{};   ///< indices into points, counter-clockwise
    std::vector<Quad> quads{};           ///< indices into points, counter-clockwise
    std::vector<Marker> markers{};       ///< those that are not internal hold, together, all edges of the boundary
    std::vector<Region> region{};        ///< per cell: its region
    std::vector<std::uint32_t> piece{};  ///< per cell: the subdomain that made it
    std::vector<std::uint16_t> layer{};  ///< per cell: number of its layer from the wall, from 1; 0 outside the layer
    /// Interior edges that need not be Delaunay: borders of the layer. The smaller vertex first; sorted.
    std::vector<Segment> constraints{};
};

/// A mesh whose arrays lie anywhere, as in files that are mapped into memory. Whoever makes a view keeps them alive.
struct MeshView {
    std::span<const Point> points;         ///< the vertices
    std::span<const Triangle> triangles;   ///< indices into points
    std::span<const Quad> quads;           ///< indices into points
    std::span<const Marker> markers;       ///< as in Mesh
    std::span<const Region> region;        ///< per cell
    std::span<const std::uint32_t> piece;  ///< per cell
    std::span<const std::uint16_t> layer;  ///< per cell
    std::span<const Segment> constraints;  ///< sorted

    MeshView() = default;
    /// Makes a view of a mesh, implicitly: functions that take a view take a mesh as well.
    LAMINA_EXPORT MeshView(const Mesh& mesh);  // NOLINT(google-explicit-constructor)
};

/// Gives markers of meshes from elsewhere legal names, and returns a warning of each that has changed.
LAMINA_EXPORT std::vector<Warning> make_marker_names_legal(std::span<Marker> markers);

/// One way in which a mesh is not valid.
struct MeshDefect {
    std::string description;  ///< "clockwise or folded triangle 17 (3, 5, 9)"
    Point at;                 ///< a vertex beside the defect; the origin where the defect has no place
};

/// Statistics of the cells of one region. All numbers are 0 where there are no cells.
struct QualitySummary {
    std::size_t cells = 0;          ///< number of cells
    double min_angle_deg = 0;       ///< smallest angle of all cells
    double max_angle_deg = 0;       ///< largest angle of all cells
    double mean_min_angle_deg = 0;  ///< mean of the smallest angles of the cells
    double mean_max_angle_deg = 0;  ///< mean of the largest angles of the cells
    /// Mean of 4 sqrt(3) area / (sum of the squared edges) for triangles, and of that of the worst corner for quads.
    double mean_ratio = 0;
    double share_below_40_deg = 0;       ///< share of the cells whose smallest angle is below 40 degrees
    std::size_t angles_below_bound = 0;  ///< cells whose smallest angle is below MeshCheckOptions::min_angle_deg
    /// The number of these cells that no refinement could mend: isotropic cells at a corner below 60 degrees between
    /// two frozen edges, and triangles whose shortest edge leads across such a corner of the boundary or of the layer.
    /// An edge counts as frozen on the boundary, between the regions, between two pieces, and on constraints. Source:
    /// J. R. Shewchuk, Delaunay refinement algorithms for triangular mesh generation (2002), on small input angles.
    std::size_t exempt = 0;
    std::size_t unexcused() const { return angles_below_bound - exempt; }  ///< those that are not exempt
    /// Largest ratio of the areas of two neighbours: two isotropic cells, or two cells of which one is of the layer.
    double max_neighbour_area_ratio = 0;
    Point max_neighbour_area_ratio_at{};   ///< the middle of this edge; of the layer alone
    double p999_neighbour_area_ratio = 0;  ///< 99.9th percentile, within 0.2 %; 0 for the layer
    double max_aspect_ratio = 0;  ///< longest edge over the height on it; for a quad, squared longest edge over area
    std::array<std::size_t, 18> angle_histogram{};  ///< number of smallest angles in [0, 5), [5, 10), ... degrees
};

/// The edges between the layer and the isotropic region; all numbers are 0 where there is none.
struct TransitionSummary {
    std::size_t edges = 0;         ///< number of edges between the two regions
    double p01_area_ratio = 0;     ///< 1st percentile of the area of the layer's cell over that of the isotropic cell
    double median_area_ratio = 0;  ///< median of that; 1 is ideal
    double p99_area_ratio = 0;     ///< 99th percentile of that
    double p90_height_ratio = 0;   ///< 90th percentile of the isotropic cell's height over that of the layer's cell
};

/// The height of a first cell is kept where it differs from the one wanted by at most this share.
inline constexpr double first_height_tolerance = 0.01;

/// The heights of the cells of the first layer on one marker, above the wall's edges.
struct FirstHeights {
    std::string marker;        ///< its name
    std::size_t cells = 0;     ///< number of edges with such a cell
    double median = 0;         ///< in units of the input
    double share_of_kept = 1;  ///< share that is kept
};

/// How evenly the walls are divided, and how high the cells on them are. Walls are markers that may_be_wall().
struct WallSummary {
    std::size_t edges = 0;            ///< number of edges on walls
    double max_ratio = 1;             ///< largest ratio of the lengths of neighbouring edges, but at corners of bases
    Point max_ratio_at{};             ///< the vertex between the two
    std::size_t uneven_vertices = 0;  ///< number of vertices where this ratio exceeds 1.25
    std::size_t bare_edges = 0;       ///< edges without a cell of the layer, on walls that have one or are of kind wall
    Point bare_at{};                  ///< the wall vertex at the start of one of them
    std::size_t first_cells = 0;      ///< number of edges with a cell of the first layer; the rest is about these
    double median_first_height = 0;   ///< height over the wall's edge, in units of the input
    double share_of_kept_heights = 1;  ///< share that is kept, of the height wanted or else of their marker's median
    double worst_first_height = 1;     ///< the height that differs most, over the height wanted
    Point worst_first_height_at{};     ///< the wall vertex at its edge's start
    std::vector<FirstHeights> first_heights{};  ///< one per marker that has such cells, in the order of the mesh
};

/// The result of check_mesh().
struct MeshCheck {
    std::vector<MeshDefect> defects;      ///< the first 20; empty: the mesh is valid
    std::size_t defect_count = 0;         ///< number of all defects
    double area = 0;                      ///< sum of the areas of the cells, in squared units of the input
    long euler_characteristic = 0;        ///< vertices - edges + cells
    std::size_t boundary_loops = 0;       ///< closed loops of boundary edges
    QualitySummary layer;                 ///< of the cells of the layer
    QualitySummary isotropic;             ///< of the other cells; of all cells where the mesh holds no regions
    TransitionSummary transition;         ///< between the two
    std::size_t interior_edges = 0;       ///< number of edges between two isotropic triangles that are no constraints
    std::size_t delaunay_violations = 0;  ///< number of those with a vertex strictly inside the opposite circle (exact)
    std::size_t edges_without_first_layer = 0;   ///< boundary edges of layer cells that reach beyond layer 1
    WallSummary walls;                           ///< of all edges of walls
    std::vector<std::uint32_t> unexcused_cells;  ///< isotropic cells with an angle below the bound that are not exempt

    bool valid() const { return defect_count == 0; }  ///< whether the mesh has no defects
};

/// Options of check_mesh().
struct MeshCheckOptions {
    double min_angle_deg = proved_min_angle_deg;  ///< bound of QualitySummary::angles_below_bound
    std::optional<double> first_height{};         ///< wanted, in units of the input; empty: the median on each marker
    std::vector<double> first_heights{};  ///< one per marker, in place of first_height; empty: all have the same
    /// Wanted at the first so many vertices of the mesh, in place of the others; empty: none has its own. The cell on
    /// an edge may have any height from that of its one end to that of its other end.
    std::vector<double> first_height_at{};
    /// Memory that the search for neighbours may take beside the mesh, but at least 64 MiB and 4 bytes a vertex: with
    /// less than it needs it reads the cells several times. The result is the same. Empty: no limit.
    std::optional<std::size_t> max_memory_bytes{};
};

LAMINA_EXPORT void validate(const MeshCheckOptions& options);  ///< throws OptionError: an option out of range
/// Checks a mesh. Throws OptionError for options out of range.
LAMINA_EXPORT MeshCheck check_mesh(const MeshView& mesh, const MeshCheckOptions& options = {});

/// Returns regions for a mesh without them, judged by shapes; none where no cell is taken for the layer. Thin cells are
/// quadrilaterals, and triangles with an angle below proved_min_angle_deg. The layer is those that hang together with a
/// wall (may_be_wall()), from vertex to vertex through thin and right-angled cells, and those that one cell parts from
/// it. Other cells of a layer, such as its last rows, count as isotropic.
LAMINA_EXPORT std::vector<Region> estimate_regions(const MeshView& mesh);
/// Returns the distance of each point to the nearest edge of a marker of kind wall; infinite where there is none.
LAMINA_EXPORT std::vector<double> wall_distances(const MeshView& mesh);

/// The vertices of the walls, body by body, counter-clockwise round each. The arrays have one entry per vertex.
struct WallVertices {
    std::vector<VertexId> vertex;         ///< index into Mesh::points
    std::vector<std::uint32_t> marker;    ///< index into Mesh::markers, of the edge that begins at the vertex
    std::vector<double> arc_length;       ///< from the first vertex of the body
    std::vector<Point> normal;            ///< unit vector into the flow: the bisector at corners
    std::vector<double> first_height;     ///< above the wall, of the lowest vertex of the cells on the two edges beside
    std::vector<std::size_t> body_first;  ///< where each body begins, followed by the number of vertices
};

/// Returns the vertices of the markers of kind wall. Precondition: check_mesh() finds no defect.
LAMINA_EXPORT WallVertices wall_vertices(const Mesh& mesh);
/// Returns a hash of the mesh as 32 hexadecimal digits, which does not depend on the numbering, and hence not on the
/// file format: the sum modulo 2^128 of one hash per cell and per marker edge. Each covers the IEEE bits of the
/// coordinates (-0 as +0), from the lexicographically smallest vertex of a cell on, and the name of the marker.
LAMINA_EXPORT std::string mesh_hash(const MeshView& mesh);

}  // namespace lamina
