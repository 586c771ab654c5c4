// Stage "check", and the mesh itself: what the program makes, checks, reads and writes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <lamina/angle_bounds.hpp>
#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/option.hpp>
#include <lamina/point.hpp>

namespace lamina {

enum class Region : std::uint8_t { layer, isotropic };
enum class MarkerKind : std::uint8_t { wall, far_field, symmetry, other };

/// A named part of the boundary; its edges are directed with the mesh on their left.
struct Marker {
    std::string name;
    MarkerKind kind = MarkerKind::other;
    std::vector<Segment> edges;
};

/// A conforming mesh of triangles and quadrilaterals. The vertices of the walls come first, in the order of the input,
/// then those of the layer, then the rest. The arrays per cell are empty, or hold one entry per triangle followed by
/// one per quadrilateral.
struct Mesh {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    std::vector<Quad> quads;
    std::vector<Marker> markers;
    std::vector<Region> region;
    std::vector<std::uint32_t> piece;  ///< the subdomain that made the cell
    std::vector<std::uint16_t> layer;  ///< the layer's number from the wall, from 1 on; 0 outside the layer
    /// Interior edges that the triangulation was constrained to, which are exempt from the Delaunay property: the outer
    /// borders of the layer. Each with the smaller vertex first; sorted.
    std::vector<Segment> constraints;
};

/// One way in which a mesh is not valid.
struct MeshDefect {
    std::string what;  ///< "inverted triangle 17 (areas, indices ...)"
    Point at;
};

/// The shapes of the cells of one region.
struct QualitySummary {
    std::size_t cells = 0;
    double min_angle_deg = 0;
    double max_angle_deg = 0;
    double mean_min_angle_deg = 0;
    double mean_max_angle_deg = 0;
    std::size_t angles_below_bound = 0;  ///< number of cells whose smallest angle is below the bound asked about
    /// How many of those are isotropic cells that no refinement could mend: at a corner below 60 degrees between two
    /// frozen edges (boundary, layer, another piece, constraints), as far as the mesh tells them.
    std::size_t exempt = 0;
    double max_neighbour_area_ratio = 0;            ///< over edges between two isotropic cells; 0 for the layer
    double p999_neighbour_area_ratio = 0;           ///< 99.9th percentile, within 0.2 %
    double max_aspect_ratio = 0;                    ///< longest edge over the height on it
    std::array<std::size_t, 18> angle_histogram{};  ///< number of smallest angles in [0, 5), [5, 10), ... degrees
};

/// The transition from the layer to the isotropic region: over all edges between the two, the area of the layer's cell
/// divided by that of the isotropic cell (ideal: 1). All 0 without such edges.
struct TransitionSummary {
    std::size_t edges = 0;
    double p01_area_ratio = 0;  ///< 1st percentile
    double median_area_ratio = 0;
    double p99_area_ratio = 0;  ///< 99th percentile
};

struct MeshCheck {
    std::vector<MeshDefect> defects;  ///< the first 20; empty: the mesh is valid
    std::size_t defect_count = 0;
    double area = 0;
    long euler_characteristic = 0;
    std::size_t boundary_loops = 0;
    QualitySummary layer;
    QualitySummary isotropic;  ///< all cells where the mesh holds no regions
    TransitionSummary transition;
    std::size_t interior_edges = 0;       ///< number of edges between two isotropic triangles that are no constraints
    std::size_t delaunay_violations = 0;  ///< number of those with a vertex strictly inside the opposite circle (exact)
    /// Number of boundary edges of layer cells that reach beyond layer 1, where the first height is not kept.
    std::size_t edges_without_first_layer = 0;

    bool valid() const { return defect_count == 0; }
};

struct MeshCheckOptions {
    double min_angle_deg = proved_min_angle_deg;  ///< for angles_below_bound
};

LAMINA_EXPORT const OptionTable<MeshCheckOptions>& mesh_check_option_table();

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const MeshCheckOptions& options);

/// Checks a mesh exactly: indices in range; counter-clockwise cells of positive area; conforming (every directed edge
/// used once); covers its domain once (signed areas, Euler characteristic, simple boundary loops, no vertex without
/// cells, no pinched vertex); every boundary edge in exactly one marker and every marker edge on the boundary. The
/// Delaunay property and the quality are measured, not demanded.
LAMINA_EXPORT MeshCheck check_mesh(const Mesh& mesh, const MeshCheckOptions& options = {});

/// Returns a hash of the mesh that does not depend on numbering, and hence not on the file format: a sum modulo 2^128
/// of one hash per cell and per marker edge, each over the IEEE bits of its vertices' coordinates (-0 as +0), cells
/// rotated to their lexicographically smallest vertex, and the marker's name. 32 lower-case hexadecimal digits; the
/// bytes that are hashed are spelt out in src/mesh/hash.cpp. Precondition: indices in range.
LAMINA_EXPORT std::string mesh_hash(const Mesh& mesh);

}  // namespace lamina
