// Morphing: a mesh of given cells is moved to other shapes of its bodies; the derivative of its places is known as
// well.
//
// Guarantees:
//  1. Walls that do not move leave every bit of the mesh as it is. What stands on the rays above a wall vertex moves
//     with it as a rigid body, so that first heights and right angles at walls stay.
//  2. A mesh is only returned where all of its cells are counter-clockwise, exactly.
//  3. Places use + - * / and square roots alone, in a fixed order, without contraction: they are the same bits on any
//     machine and any number of threads.
// Limits:
//  1. The outer boundary, and all markers that are no walls, stay; vertices of horizontal lines of symmetry, as slip
//     ground is one, slide along them. Lines inside the mesh move with it. In slots that close, rays get shorter beyond
//     their first ten layers.
//  2. A map is one step from its reference mesh. Motions that turn a cell over end before that, or with a MeshError,
//     unless MorphOptions::incremental makes several steps of them.
// Example:
//     const Mesh mesh = generate_mesh({"naca:0012:80"}, {.layer = {.first_height = 1e-3, .layers = 8}}).mesh;
//     const MorphMap map(mesh);
//     const std::vector<Point> thicker = wall_points_on(map, make_geometry({naca_airfoil("0013", 400)}));
//     const MorphResult morphed = morph(map, thicker);
//     assert(morphed.fraction == 1 && morphed.points.size() == mesh.points.size());
//
// Source: E. Luke, E. Collins, E. Blades, A fast mesh deformation method using explicit interpolation, J. Comput. Phys.
// 231 (2012), section 2: each wall vertex has a displacement and a turn, and the mesh blends both. The blend here
// solves Laplace's equation with a stiffness that grows where cells are small.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/mesh.hpp>

namespace lamina {

/// The map from places of the wall vertices to those of all vertices, factored once for a reference mesh.
class LAMINA_EXPORT MorphMap {
public:
    /// Precondition: check_mesh() finds no defect. The mesh must outlive the map.
    explicit MorphMap(const Mesh& reference);
    MorphMap(MorphMap&&) noexcept;             ///< leaves nothing but destruction to the other object
    MorphMap& operator=(MorphMap&&) noexcept;  ///< does the same, and gives up the factors of this object
    ~MorphMap();

    const Mesh& reference() const;                  ///< the mesh that it is made for
    const WallVertices& walls() const;              ///< the vertices that move as they are told
    const std::vector<Point>& wall_points() const;  ///< where they are in the reference mesh

    // These three throw InputError for other numbers of points.

    /// Returns the places of all vertices where the wall vertices, in the order of walls(), move to these points.
    std::vector<Point> positions(std::span<const Point> wall) const;
    /// Returns the derivative of positions() in a direction of the wall points.
    std::vector<Point> jacobian_vector(std::span<const Point> wall, std::span<const Point> direction) const;
    /// Returns the gradient by the wall points of a function whose gradient by the places of all vertices is given.
    std::vector<Point> vector_jacobian(std::span<const Point> wall, std::span<const Point> gradient) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Options of morph().
struct MorphOptions {
    bool as_far_as_possible = false;  ///< whether a motion that stops on the way is returned as far as it goes
    /// Whether a motion that stops goes on from a mesh half as far, by a map of that mesh, and so on. Walls get there
    /// in a straight line. The derivative of the first map is not that of the result.
    bool incremental = false;
};

/// A mesh that was morphed, without its cells, which are those of the reference.
struct MorphResult {
    std::vector<Point> points;         ///< the places of all vertices
    double fraction = 1;               ///< how much of the motion was made: in one step, a multiple of 1/64
    std::optional<MeshDefect> stop{};  ///< the cell that stops it, and where it is before the last map; empty: none
    int maps = 1;                      ///< by how many maps it was made, one after the other
};

/// Moves the wall vertices in the order of MorphMap::walls() to these points, or in a straight line as far as all cells
/// stay counter-clockwise. Throws InputError for a wrong number of points, for numbers that are not finite, for
/// neighbours at one place and for bodies that would cross, and MeshError, with the cell that stops it, where it gets
/// nowhere or only to a fraction that is not asked for.
LAMINA_EXPORT MorphResult morph(const MorphMap& map, std::span<const Point> wall, const MorphOptions& options = {});

/// Returns the wall vertices on other shapes of the bodies, which are matched in their order. Between two corners they
/// divide the arc length as they do in the mesh, on a spline through the points of the shape. Kinks, corners of at most
/// 60 degrees, may appear, and get a vertex, and vanish. Walls with ends stay.
/// Throws InputError for another number of bodies, and where sharp corners appear or vanish.
LAMINA_EXPORT std::vector<Point> wall_points_on(const MorphMap& map, const Geometry& shape);
/// Returns the wall vertices with the bodies changed: elements are the markers of the walls. Those of deflected flaps
/// are what wall_points_on() returns. Throws what transformed() throws, and what wall_points_on() throws.
LAMINA_EXPORT std::vector<Point> moved_wall_points(const MorphMap& map, std::span<const Transformation> changes);

/// Returns the wall vertices with displacements from a CSV file added: lines "vertex,dx,dy", of which the first may be
/// a heading. Vertices are those of the mesh, from 0; those without a line stay. Throws IoError, and InputError with
/// the line where it is none of these, or names a vertex that is on no wall or was named before.
LAMINA_EXPORT std::vector<Point> displaced_wall_points(const MorphMap& map, const std::filesystem::path& file);

/// A turn that swings: mean + amplitude sin(2 pi frequency time).
struct Pitching {
    double mean_deg = 0;       ///< in [-180, 180]
    double amplitude_deg = 0;  ///< in [-180, 180]
    double frequency = 0;      ///< periods in a unit of time, > 0
};

/// A turn that begins and ends at rest: angle (1 - cos(pi time / duration)) / 2, and the angle from then on.
struct Deflecting {
    double angle_deg = 0;  ///< in [-180, 180]
    double duration = 0;   ///< > 0
};

/// How an element turns about a point as time goes on. Angles are positive clockwise: nose up, trailing edge down.
struct TurnInTime {
    std::string element;                        ///< name of the element, or "all"
    std::variant<Pitching, Deflecting> course;  ///< the angle as a function of time
    Point center{};                             ///< of the turn
};

/// Reads "ELEMENT:pitch:MEAN:AMPLITUDE:FREQUENCY[:X,Y]" or "ELEMENT:deflect:DEG:DURATION[:X,Y]". Throws UsageError with
/// the bare reason, also for numbers out of range.
LAMINA_EXPORT TurnInTime parse_turn_in_time(const std::string& text);
/// Returns the time of one period, or the duration.
LAMINA_EXPORT double duration_of(const TurnInTime& turn);
/// Returns the turn that the element has made at a time >= 0.
LAMINA_EXPORT Transformation turn_at(const TurnInTime& turn, double time);

/// The quality of all cells of a mesh.
struct MorphQuality {
    double min_angle_deg = 0;       ///< smallest angle
    double mean_min_angle_deg = 0;  ///< mean of the smallest angles of the cells
    /// Smallest scaled Jacobian: the sine of an angle of a quad or, over that of 60 degrees, of a triangle. Source: P.
    /// M. Knupp, Achieving finite element mesh quality via optimization of the Jacobian matrix norm (2000).
    double min_scaled_jacobian = 0;
};

/// A mesh before and after.
struct MorphReport {
    MorphQuality before;                 ///< of the reference mesh
    MorphQuality after;                  ///< of the morphed one
    double max_first_height_change = 0;  ///< largest change of WallVertices::first_height, as a share of it
    Point max_first_height_change_at{};  ///< at this wall vertex of the reference mesh
};

/// Measures both meshes. Throws InputError for another number of points.
LAMINA_EXPORT MorphReport compare_morphed(const MorphMap& map, std::span<const Point> points);
/// Measures both meshes, of which the latter may have other cells between the same vertices, as those of reconnect()
/// are. Throws InputError for another number of points, and where the walls have other vertices. Precondition:
/// check_mesh() finds no defect.
LAMINA_EXPORT MorphReport compare_morphed(const MorphMap& map, const Mesh& morphed);

}  // namespace lamina
