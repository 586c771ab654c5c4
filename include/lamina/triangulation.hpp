// Delaunay triangulation and constrained Delaunay triangulation of points of the plane.
//
// Guarantees:
//  1. Triangulations are exactly Delaunay, by the tie rule of predicates.hpp between cocircular points, however close
//     to degenerate the input is, and the work always ends.
//  2. The set of triangles depends on the set of points and segments alone, not on their order (but for the numbers of
//     crossing points); triangles and their order are the same on any number of threads.
//  3. Triangles are counter-clockwise and index the points handed in, which keep their numbers. Steiner points follow.
// Limits:
//  1. Coordinates are 0 or from 1e-60 to 1e60 in magnitude; others are an InputError, as are equal points unless they
//     are merged (ConstrainedOptions::merge_distance).
//  2. Time is O(n log n) in practice. Fewer than three points, and points on one line, have no triangles.
// Example:
//     const std::vector<Point> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
//     const std::vector<Segment> segments{{VertexId{0u}, VertexId{2u}}};
//     const ConstrainedTriangulation halves = triangulate(points, segments);
//     assert(halves.triangles.size() == 2 && halves.segments == segments);
//     assert(check_triangulation(points, halves.triangles, halves.segments).empty());
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The limits of a decomposition into pieces. The pieces depend on these numbers and on the points alone.
struct DecompositionOptions {
    unsigned depth = 6;                 ///< largest number of cuts on the way to a piece
    std::size_t leaf_vertices = 5'000;  ///< pieces with at most this many vertices are not cut further
};

/// The numbers of pieces, cuts and fallbacks of a decomposition.
struct DecompositionStats {
    std::size_t pieces = 0;          ///< number of pieces
    std::size_t piece_vertices = 0;  ///< vertices, summed over pieces; those on a dividing path count in each beside it
    std::size_t largest_piece = 0;   ///< number of vertices of the largest piece
    std::size_t crossing_cuts = 0;   ///< cuts rejected because their path crossed a segment
    std::size_t unbalanced_cuts = 0;  ///< cuts rejected because one part was larger than 0.75 of the whole
    std::size_t long_cuts = 0;        ///< cuts rejected because a sixteenth of all points and more lay on their path
    std::size_t uncut = 0;            ///< pieces that should have been cut further, but for which no cut was good
    std::size_t fallbacks = 0;        ///< regions triangulated at once because one of their pieces could not be
};

/// The seconds that one thread spent while points were triangulated in pieces.
struct TriangulationThread {
    double cutting = 0;        ///< cutting pieces
    double triangulating = 0;  ///< triangulating them
    double idle = 0;           ///< waiting
};

/// A triangulation.
struct Triangulation {
    std::vector<Triangle> triangles;             ///< counter-clockwise
    DecompositionStats decomposition{};          ///< how the points were cut into pieces
    std::vector<TriangulationThread> threads{};  ///< one entry per thread
};

/// Returns the Delaunay triangulation of distinct points. Sets of 50,000 points and more are divided along paths of
/// Delaunay edges, and the pieces triangulated on several threads. Throws InputError for duplicates (place().points).
/// Source: biased randomised insertion order (N. Amenta, S. Choi, G. Rote, SoCG 2003) along a Hilbert curve; cavity
/// insertion (A. Bowyer, D. F. Watson, The Computer Journal 24 (1981)); pieces: G. E. Blelloch, G. L. Miller, J. C.
/// Hardwick, D. Talmor, Algorithmica 24 (1999); J. K. Pardue, thesis (2015), chapter 4.
LAMINA_EXPORT Triangulation triangulate(std::span<const Point> points);
/// Returns the same, made in the pieces that the options demand, whatever the number of points; but points that lie on
/// few lines or circles stay in one. Throws OptionError for options out of range, too.
LAMINA_EXPORT Triangulation triangulate(std::span<const Point> points, const DecompositionOptions& options);

/// The triangles that are kept of a constrained triangulation, before holes are cut.
enum class KeptRegion {
    convex_hull,       ///< all triangles
    inside_segments,   ///< those that cannot be reached from outside the hull without crossing a segment
    left_of_segments,  ///< those that can be reached from the left side of a segment without crossing one
    even_odd,          ///< those that an odd number of segments of closed loops parts from the outside (GeoJSON, SVG)
    non_zero,          ///< those that closed loops wind round, not as often one way as the other (fonts, SVG)
};

/// How triangulate() treats segments that cross in their interiors.
enum class Crossings {
    refuse,  ///< throws an InputError that names both segments
    /// Inserts a Steiner point at each crossing, rounded to doubles, or leads both segments through a point within
    /// rounding of it, and through points that they pass within 4 units in the last place of their largest coordinate.
    /// They stay planar and bend by at most 16 of these units. Crossings below 1e-60 become 0 or 1e-60.
    insert,
};

/// The largest ConstrainedOptions::drop_flat.
inline constexpr double max_drop_flat = 0.1;

/// Options of constrained triangulation.
struct ConstrainedOptions {
    KeptRegion keep = KeptRegion::convex_hull;  ///< the triangles that are kept
    Crossings crossings = Crossings::refuse;    ///< what happens where segments cross
    std::vector<Point> holes{};  ///< one point in each hole; InputError on a vertex or a segment, no effect outside
    /// Points at most this far from an earlier one are taken for the same (merge_points()); 0 merges equal points;
    /// empty: they are an InputError. With Crossings::insert segments are led through points at most this far from
    /// them, too, which merges those that nearly coincide. They bend by at most four times this, or it is an
    /// InputError.
    std::optional<double> merge_distance{};
    /// Triangles are dropped, from the outside inwards, whose corners all lie within this share of the length of an
    /// edge of the convex hull from that edge: those that rounding makes of points on a straight side. No segment,
    /// vertex or connection is lost by it. OptionError above max_drop_flat, and unless KeptRegion::convex_hull is kept.
    double drop_flat = 0;
    std::optional<DecompositionOptions> decomposition{};  ///< empty: as triangulate() of points does without it
};

/// A constrained triangulation.
struct ConstrainedTriangulation {
    std::vector<Point> steiner_points;  ///< crossings of segments
    std::vector<Triangle> triangles;    ///< counter-clockwise
    /// The edges that are parts of segments: each once, directed as its segment is, in the order of the segments.
    std::vector<Segment> segments;
    std::vector<std::uint32_t> parents;     ///< for each edge the segment that it is a part of; the first of several
    std::size_t zero_length_segments = 0;   ///< number of segments from a point to itself, which are left out
    std::size_t repeated_segments = 0;      ///< number of segments that change nothing because they lie on earlier ones
    std::size_t dropped_triangles = 0;      ///< number of flat triangles dropped (ConstrainedOptions::drop_flat)
    std::vector<std::size_t> idle_holes{};  ///< indices of the holes that take no triangle away
    /// For each point the one that stands for it, itself if it was not merged; empty without merge_distance.
    std::vector<std::uint32_t> merged_into{};
    DecompositionStats decomposition{};  ///< how points and segments were cut into pieces
};

/// Returns the constrained Delaunay triangulation: every segment is an edge or, where it runs through points, a chain
/// of edges; the other edges are locally Delaunay. Segments may overlap and repeat. Throws InputError for points as
/// triangulate(points) does, for segments whose ends are not both among the points, for segments that cross, if all
/// points lie on one line, and where segments form no closed loops though they have to; for holes outside the exact
/// range (place().seeds). Throws OptionError for a merge distance below 0 or above 1e60. Source: M. V. Anglada,
/// Computers & Graphics 21 (1997).
LAMINA_EXPORT ConstrainedTriangulation triangulate(std::span<const Point> points, std::span<const Segment> segments,
                                                   const ConstrainedOptions& options = {});

/// Returns for each point the point that stands for it: the first one at most `distance` away (rounded) that stands for
/// itself. Takes O(n) on average, O(n log n) for distance 0. Throws OptionError for a distance below 0 or above 1e60.
LAMINA_EXPORT std::vector<std::uint32_t> merge_points(std::span<const Point> points, double distance);
/// Returns the segments of closed rings of points: ring r holds the points from starts[r] on, up to the next ring or to
/// the last point. A ring may repeat its first point at its end, as in GeoJSON, where
/// ConstrainedOptions::merge_distance is given. Throws InputError for starts that do not ascend or exceed the number of
/// points.
LAMINA_EXPORT std::vector<Segment> ring_segments(std::size_t points, std::span<const std::size_t> starts);

/// Options of check_triangulation().
struct TriangulationCheckOptions {
    bool require_delaunay = true;  ///< whether edges that are no constraints must be locally Delaunay
};

/// Returns the first 20 defects of a triangulation of these points, one line each; none if it is valid. Defects are
/// indices out of range, clockwise or flat triangles, edges used twice in one direction, triangles that overlap round a
/// vertex, constraints that are no edges, and edges that are not Delaunay. Exact.
LAMINA_EXPORT std::vector<std::string> check_triangulation(std::span<const Point> points,
                                                           std::span<const Triangle> triangles,
                                                           std::span<const Segment> constraints = {},
                                                           const TriangulationCheckOptions& options = {});
/// Returns the smallest angle of all triangles in degrees, to 1e-12 degrees; 0 without triangles.
LAMINA_EXPORT double smallest_angle_deg(std::span<const Point> points, std::span<const Triangle> triangles);

}  // namespace lamina
