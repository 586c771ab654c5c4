// The mesh, and stage "check", which proves that a mesh is valid and measures its quality.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/angle_bounds.hpp>
#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/marker_names.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The part of the mesh that a cell belongs to.
enum class Region : std::uint8_t {
    layer,     ///< the anisotropic cells next to the walls
    isotropic  ///< all other cells
};

/// A named part of the boundary.
struct Marker {
    std::string name;                     ///< unique in the mesh
    MarkerKind kind = MarkerKind::other;  ///< the boundary condition
    std::vector<Segment> edges;           ///< directed with the mesh on their left
};

/// A conforming mesh of triangles and quadrilaterals. The vertices of the walls come first, in the order of the input,
/// then those of the layer, then the rest. The arrays per cell are empty, or hold one entry per triangle followed by
/// one per quadrilateral.
struct Mesh {
    std::vector<Point> points;         ///< the vertices
    std::vector<Triangle> triangles;   ///< indices into points, counter-clockwise
    std::vector<Quad> quads;           ///< indices into points, counter-clockwise
    std::vector<Marker> markers;       ///< together, all edges of the boundary
    std::vector<Region> region;        ///< per cell: its region
    std::vector<std::uint32_t> piece;  ///< per cell: the subdomain that made it
    std::vector<std::uint16_t> layer;  ///< per cell: the number of its layer from the wall, from 1; 0 outside the layer
    /// Interior edges that the triangulation was constrained to, which are exempt from the Delaunay property: the outer
    /// borders of the layer. Each with the smaller vertex first; sorted.
    std::vector<Segment> constraints;
};

/// A mesh whose arrays lie anywhere: in a Mesh, or in files that are mapped into memory. The members mean what those of
/// Mesh mean. Whoever makes a view keeps the arrays alive.
struct MeshView {
    std::span<const Point> points;         ///< the vertices
    std::span<const Triangle> triangles;   ///< indices into points
    std::span<const Quad> quads;           ///< indices into points
    std::span<const Marker> markers;       ///< together, all edges of the boundary
    std::span<const Region> region;        ///< per cell
    std::span<const std::uint32_t> piece;  ///< per cell
    std::span<const std::uint16_t> layer;  ///< per cell
    std::span<const Segment> constraints;  ///< sorted

    /// Makes a view of nothing.
    MeshView() = default;
    /// Makes a view of a mesh. It is implicit, so that functions that take a view take a mesh as well.
    MeshView(const Mesh& mesh)  // NOLINT(google-explicit-constructor)
        : points(mesh.points),
          triangles(mesh.triangles),
          quads(mesh.quads),
          markers(mesh.markers),
          region(mesh.region),
          piece(mesh.piece),
          layer(mesh.layer),
          constraints(mesh.constraints) {}
};

/// Gives markers legal names (marker_names.hpp), and returns a warning of each name that has changed. It is for meshes from
/// elsewhere: those that lamina makes have legal names.
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
    /// Mean of the mean ratios of the cells: 4 sqrt(3) area / (sum of the squared edges) for a triangle, that of the
    /// worst corner for a quad; 1 for equilateral triangles and squares.
    double mean_ratio = 0;
    double share_below_40_deg = 0;  ///< share of the cells whose smallest angle is below 40 degrees
    /// Number of cells whose smallest angle is below MeshCheckOptions::min_angle_deg.
    std::size_t angles_below_bound = 0;
    /// The number of these cells that are exempt since no refinement could mend them. They are isotropic cells at a
    /// corner below 60 degrees between two frozen edges, and triangles whose shortest edge leads across such a corner
    /// of the boundary or of the layer. An edge counts as frozen where the mesh shows it: on the boundary, between the
    /// regions, between two pieces, and on constraints. Source: J. R. Shewchuk, Delaunay refinement algorithms for
    /// triangular mesh generation (2002), on small input angles.
    std::size_t exempt = 0;
    /// Returns the number of angles below the bound that are not exempt.
    std::size_t unexcused() const { return angles_below_bound - exempt; }
    /// Largest ratio of the areas of two neighbours: of the isotropic region over edges between two of its cells, of the
    /// layer over edges that at least one of its cells has.
    double max_neighbour_area_ratio = 0;
    Point max_neighbour_area_ratio_at{};   ///< the middle of this edge; of the layer alone
    double p999_neighbour_area_ratio = 0;  ///< 99.9th percentile, within 0.2 %; 0 for the layer
    /// Longest edge over the height on it; for a quad, squared longest edge over area.
    double max_aspect_ratio = 0;
    std::array<std::size_t, 18> angle_histogram{};  ///< number of smallest angles in [0, 5), [5, 10), ... degrees
};

/// The transition from the layer to the isotropic region. The area ratio at an edge between the two is the area of the
/// layer's cell divided by the area of the isotropic cell; 1 is ideal. The height ratio is the height of the isotropic
/// cell over the edge divided by that of the layer's cell; above 1 the mesh jumps to larger cells at the layer's end. All
/// numbers are 0 where there is no edge.
struct TransitionSummary {
    std::size_t edges = 0;         ///< number of edges between the two regions
    double p01_area_ratio = 0;     ///< 1st percentile
    double median_area_ratio = 0;  ///< median
    double p99_area_ratio = 0;     ///< 99th percentile
    double p90_height_ratio = 0;   ///< 90th percentile
};

/// Neighbouring wall edges are even where the ratio of their lengths is at most this.
inline constexpr double even_wall_ratio = 1.25;
/// The height of a first cell is kept where it differs from the one wanted by at most this share.
inline constexpr double first_height_tolerance = 0.01;

/// The heights of the cells of the first layer on one marker, above the wall's edges.
struct FirstHeights {
    std::string marker;        ///< its name
    std::size_t cells = 0;     ///< number of edges with such a cell
    double median = 0;         ///< in units of the input
    double share_of_kept = 1;  ///< share within first_height_tolerance of the height wanted on this marker
};

/// How evenly the walls are divided, and how high the cells on them are. A marker counts as a wall unless it is a far
/// field or a symmetry.
struct WallSummary {
    std::size_t edges = 0;  ///< number of edges on walls
    double max_ratio = 1;   ///< largest ratio of the lengths of neighbouring edges, but across the corners of bases
    Point max_ratio_at{};   ///< the vertex between the two
    std::size_t uneven_vertices = 0;  ///< number of vertices where this ratio exceeds even_wall_ratio
    /// Number of edges without a cell of the layer, on walls that have such cells elsewhere or are known to be walls,
    /// in a mesh with a layer.
    std::size_t bare_edges = 0;
    Point bare_at{};                 ///< the wall vertex at the start of one of them
    std::size_t first_cells = 0;     ///< number of edges with a cell of the first layer; the rest is about these
    double median_first_height = 0;  ///< height over the wall's edge, in units of the input
    /// Share of the heights within first_height_tolerance of the height wanted, or else of their marker's median.
    double share_of_kept_heights = 1;
    double worst_first_height = 1;              ///< the height that differs most, over the height wanted
    Point worst_first_height_at{};              ///< the wall vertex at its edge's start
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
    /// Number of boundary edges of layer cells that reach beyond layer 1, where the first height is not kept.
    std::size_t edges_without_first_layer = 0;
    WallSummary walls;                           ///< of all edges of walls
    std::vector<std::uint32_t> unexcused_cells;  ///< isotropic cells with an angle below the bound that are not exempt

    /// Returns whether the mesh has no defects.
    bool valid() const { return defect_count == 0; }
};

/// Options of check_mesh().
struct MeshCheckOptions {
    double min_angle_deg = proved_min_angle_deg;  ///< bound of QualitySummary::angles_below_bound
    /// The height that first cells should have, in units of the input; empty: their median on each marker.
    std::optional<double> first_height{};
    std::vector<double> first_heights{};  ///< one per marker, in place of first_height; empty: all have the same
    /// Memory that the search for neighbours may take beside the mesh: a check that would need more reads the cells
    /// several times, but needs at least 64 MiB and 4 bytes for each vertex. Empty: no limit. The result is the same.
    std::optional<std::size_t> max_memory_bytes{};
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const MeshCheckOptions& options);

/// Checks a mesh exactly. A mesh is valid if its indices are in range; its cells are counter-clockwise and have
/// positive area; it is conforming (each directed edge is used once); it covers its domain once (signed areas, Euler
/// characteristic, simple boundary loops, no vertex without cells, no vertex that the boundary passes twice); each
/// boundary edge is in exactly one marker, and each edge of a marker is on the boundary. The Delaunay property and the
/// quality are measured but not required. Throws OptionError for options out of range.
LAMINA_EXPORT MeshCheck check_mesh(const MeshView& mesh, const MeshCheckOptions& options = {});

/// Returns regions for a mesh without them, judged by the shapes of the cells. Thin cells are quadrilaterals, and
/// triangles with an angle below proved_min_angle_deg. Those that hang together with a wall, from vertex to vertex
/// through thin and right-angled cells, are taken for the layer, and so are those that one cell parts from it; a marker
/// counts as a wall unless it is a far field or a symmetry. Other cells of a layer, such as its last rows, count as
/// isotropic. Empty where no cell is taken for the layer. Precondition: all indices are in range.
LAMINA_EXPORT std::vector<Region> estimate_regions(const MeshView& mesh);

/// Returns the distance of each point to the nearest edge of a marker of kind wall; infinite where there is none.
LAMINA_EXPORT std::vector<double> wall_distances(const MeshView& mesh);

/// The vertices of the walls, body by body in the order of the outline, counter-clockwise round each. The arrays have
/// one entry per vertex.
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

/// Returns a hash of the mesh as 32 lower-case hexadecimal digits. It does not depend on the numbering, and hence not
/// on the file format: it is the sum modulo 2^128 of one hash per cell and per marker edge. Each covers the IEEE bits
/// of the vertices' coordinates (-0 as +0), from the lexicographically smallest vertex of a cell on, and the name of
/// the marker. src/mesh/hash.cpp spells out the bytes. Precondition: all indices are in range.
LAMINA_EXPORT std::string mesh_hash(const MeshView& mesh);

}  // namespace lamina
