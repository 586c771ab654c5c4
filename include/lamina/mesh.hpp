// The mesh: what the program makes, checks, reads and writes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

enum class Region : std::uint8_t { layer, isotropic };
enum class MarkerKind : std::uint8_t { wall, far_field, symmetry, other };

/// A named part of the boundary; edges are directed with the mesh on their left.
struct Marker {
    std::string name;
    MarkerKind kind = MarkerKind::other;
    std::vector<Segment> edges;
};

/// Quadrilateral, counter-clockwise.
struct Quad {
    VertexId v[4];
};

/// Conforming mesh of triangles and quadrilaterals. Vertices of the walls come first, in the order of the input, then
/// the layer's, then the rest. The per-cell arrays are empty or one entry a triangle, then one a quad.
struct Mesh {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    std::vector<Quad> quads;
    std::vector<Marker> markers;
    std::vector<Region> region;
    std::vector<std::uint32_t> piece;  ///< subdomain that made the cell
    std::vector<std::uint16_t> layer;  ///< layer number from the wall, 1-based; 0 outside the layer
    /// Interior edges that were input to the triangulation (the layer's outer borders): exempt from the Delaunay
    /// property. Each with the smaller vertex first; sorted.
    std::vector<Segment> constraints;
};

/// Gives the base of each blunt trailing edge a marker of its own, of kind wall, named as its element's with `_base`
/// behind it. Returns how many there are. Markers whose edges are no closed loop in order stay as they are.
std::size_t add_base_markers(Mesh& mesh);

/// One way in which a mesh is not valid.
struct MeshDefect {
    std::string what;  ///< "inverted triangle 17 (areas, indices ...)"
    Point at;
};

struct QualitySummary {
    std::size_t cells = 0;
    double min_angle_deg = 0;
    double max_angle_deg = 0;
    double mean_min_angle_deg = 0;
    double mean_max_angle_deg = 0;
    std::size_t angles_below_bound = 0;  ///< cells whose smallest angle is under the bound asked about
    /// Of those, isotropic ones that no refinement could mend: at a corner below 60 degrees between two frozen edges
    /// (boundary, layer, another piece, constraints), as far as the mesh tells them.
    std::size_t exempt = 0;
    double max_neighbour_area_ratio = 0;            ///< over edges between two isotropic cells; 0 for the layer
    double p999_neighbour_area_ratio = 0;           ///< 99.9th percentile, within 0.2 %
    double max_aspect_ratio = 0;                    ///< longest edge over the height on it
    std::array<std::size_t, 18> angle_histogram{};  ///< smallest angles in classes of 5 degrees... [0,5), [5,10), ...
};

/// Area of the layer's cell over that of the isotropic one, over all edges between the two regions; 0 without any.
struct HandOverSummary {
    std::size_t edges = 0;
    double p01_area_ratio = 0;  ///< 1st percentile
    double median_area_ratio = 0;
    double p99_area_ratio = 0;  ///< 99th percentile
};

struct MeshCheck {
    std::vector<MeshDefect> defects;  ///< empty = valid; at most 20 are kept
    std::size_t defect_count = 0;
    double area = 0;
    long euler_characteristic = 0;
    std::size_t boundary_loops = 0;
    QualitySummary layer;
    QualitySummary isotropic;             ///< all cells where the mesh holds no regions
    HandOverSummary hand_over;            ///< from the layer to the isotropic region
    std::size_t interior_edges = 0;       ///< edges between two isotropic triangles that are no constraints
    std::size_t delaunay_violations = 0;  ///< of those, edges with a vertex strictly inside the opposite circle (exact)
    /// Boundary edges of layer cells that reach beyond layer 1: the first height is not kept there.
    std::size_t edges_without_first_layer = 0;
    bool valid() const { return defect_count == 0; }
};

struct MeshCheckOptions {
    double min_angle_deg = 20.7;  ///< for angles_below_bound
};

/// Exact check of everything `lamina check` promises: indices in range; counter-clockwise cells of positive area;
/// conforming (every directed edge used once); covers its domain once (signed areas, Euler characteristic, simple
/// boundary loops, no orphan vertex, no pinched vertex); every boundary edge in exactly one marker and every marker
/// edge on the boundary. Delaunay property and quality are reported, not demanded.
MeshCheck check_mesh(const Mesh& mesh, const MeshCheckOptions& options = {});

/// 128-bit sum modulo 2^128 of one hash per cell and per marker edge, each over the IEEE bits of its vertices'
/// coordinates (-0 as +0), cells rotated to their lexicographically smallest vertex, and the marker's name.
/// Independent of numbering, hence of the file format. 32 lower-case hexadecimal digits.
/// Precondition: indices in range. The bytes hashed are spelt out in src/mesh/hash.cpp.
std::string mesh_hash(const Mesh& mesh);

}  // namespace lamina
