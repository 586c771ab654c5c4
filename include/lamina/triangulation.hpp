// Delaunay triangulation and constrained triangulation (docs/library.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

// ---- plain triangulation ----

/// The limits of a decomposition into pieces. The pieces depend on these numbers and on the points alone, never on the
/// number of threads.
struct DecompositionOptions {
    unsigned depth = 6;                 ///< largest number of cuts on the way to a piece
    std::size_t leaf_vertices = 5'000;  ///< pieces with at most this many vertices are not cut further
};

/// The numbers of pieces, cuts and fallbacks of a decomposition.
struct DecompositionStats {
    std::size_t pieces = 0;  ///< number of pieces
    /// Number of vertices, summed over pieces: a vertex on a dividing path counts in every piece that it belongs to.
    std::size_t piece_vertices = 0;
    std::size_t largest_piece = 0;    ///< number of vertices of the largest piece
    std::size_t crossing_cuts = 0;    ///< cuts rejected because their path crossed a segment
    std::size_t unbalanced_cuts = 0;  ///< cuts rejected because one part was larger than 0.75 of the whole
    std::size_t long_cuts = 0;        ///< cuts rejected because a sixteenth of all points and more lay on their path
    std::size_t uncut = 0;            ///< pieces that should have been cut further, but for which no cut was good
    std::size_t fallbacks = 0;        ///< regions triangulated at once because one of their pieces could not be
};

/// The time that one thread spent while points were triangulated in pieces, in seconds.
struct TriangulationThread {
    double cutting = 0;        ///< time in which the thread cut pieces
    double triangulating = 0;  ///< time in which it triangulated pieces
    double idle = 0;           ///< time in which it had nothing to do
};

/// A triangulation. The triangles hold indices into the points of the input.
struct Triangulation {
    std::vector<Triangle> triangles;             ///< counter-clockwise
    DecompositionStats decomposition{};          ///< how the points were cut into pieces
    std::vector<TriangulationThread> threads{};  ///< one entry per thread
};

/// Returns the Delaunay triangulation of distinct points in any order, in O(n log n) in practice. Cocircular points are
/// fanned by the one tie rule (predicates.hpp), so the set of triangles is unique and does not depend on the order of
/// the points. Sets of 50,000 points and more are divided along paths of Delaunay edges, and the pieces triangulated on
/// several threads; the triangles and their order are the same on any number of threads. Fewer than three points, and
/// points on one line, have no triangles. Throws InputError for duplicates (place().points) and for coordinates outside
/// the exact range.
/// Source: biased randomised insertion order (N. Amenta, S. Choi, G. Rote, SoCG 2003) along a Hilbert curve; cavity
/// insertion (A. Bowyer, D. F. Watson, The Computer Journal 24 (1981)); pieces: G. E. Blelloch, G. L. Miller, J. C.
/// Hardwick, D. Talmor, Algorithmica 24 (1999); J. K. Pardue, thesis (2015), chapter 4.
LAMINA_EXPORT Triangulation triangulate(std::span<const Point> points);

/// Returns the same triangulation, made in the pieces that the options demand, whatever the number of points; but points
/// that lie on few lines or circles stay in one. Throws OptionError for options out of range, too.
LAMINA_EXPORT Triangulation triangulate(std::span<const Point> points, const DecompositionOptions& options);

// ---- constrained triangulation ----

/// The triangles that are kept of a constrained triangulation, before holes are cut.
enum class KeptRegion {
    convex_hull,       ///< all triangles
    inside_segments,   ///< those that cannot be reached from outside the hull without crossing a segment
    left_of_segments,  ///< those that can be reached from the left side of a segment without crossing one: segments run
                       ///< counter-clockwise round the region and clockwise round its holes
    even_odd,  ///< those that an odd number of segments parts from the outside: rings in any direction, rings in
               ///< rings being holes (GeoJSON, earcut, SVG's evenodd). Segments form closed loops
    non_zero,  ///< those that segments wind round, not as often one way as the other: the union of rings in one
               ///< direction (fonts, SVG's nonzero). Segments form closed loops
};

/// How triangulate() treats segments that cross in their interiors.
enum class Crossings {
    refuse,  ///< throws an InputError that names both segments
    insert,  ///< inserts a Steiner point at each crossing, rounded to doubles, or leads both segments through a point
             ///< that stands within rounding of it. Leads segments through points that they pass within rounding, too:
             ///< 4 units in the last place of their largest coordinate. They stay planar and bend by at most 16 of
             ///< these units; coordinates of crossings below 1e-60 become 0 or 1e-60
};

/// The largest ConstrainedOptions::drop_flat: what is higher is a shape of its own.
inline constexpr double max_drop_flat = 0.1;

/// Options of constrained triangulation.
struct ConstrainedOptions {
    KeptRegion keep = KeptRegion::convex_hull;  ///< the triangles that are kept
    Crossings crossings = Crossings::refuse;    ///< what happens where segments cross
    /// One point in each hole. Triangles that can be reached from it without crossing a segment are removed. Points
    /// outside the hull have no effect; a point on a vertex or a segment is an InputError.
    std::vector<Point> holes{};
    /// Points at most this far from an earlier one are taken for the same (merge_points()); segments that join two of
    /// these have no length. 0 merges equal points. Empty: equal points are an InputError. With Crossings::insert segments
    /// are led through points at most this far from them, too, which merges those that nearly coincide; they bend by at
    /// most four times this distance, and where they would have to bend further, that is an InputError.
    std::optional<double> merge_distance{};
    /// Triangles are dropped that lie, with all corners, within this share of the length of an edge of the convex hull from
    /// that edge: those that rounding makes of points on a straight side. It goes from the outside inwards. No segment, no
    /// vertex and no connection is lost by it. 0: none is dropped. OptionError above max_drop_flat, and unless KeptRegion::convex_hull
    /// is kept: the boundary consists of segments otherwise.
    double drop_flat = 0;
    /// The pieces that points are divided into; empty: as triangulate() of points does without DecompositionOptions.
    std::optional<DecompositionOptions> decomposition{};
};

/// A constrained triangulation. Triangles and segments index the points of the input, followed by `steiner_points`.
struct ConstrainedTriangulation {
    std::vector<Point> steiner_points;  ///< crossings of segments
    std::vector<Triangle> triangles;    ///< counter-clockwise
    /// The edges of the triangles that are parts of segments: each once, directed as its segment is, in the order of
    /// the segments and, within a segment, from its a to its b.
    std::vector<Segment> segments;
    std::vector<std::uint32_t> parents;    ///< for each edge the segment that it is a part of; the first of several
    std::size_t zero_length_segments = 0;  ///< number of segments from a point to itself, which are left out
    /// Number of segments that change nothing because they lie on earlier ones, as repeated ones do.
    std::size_t repeated_segments = 0;
    std::size_t dropped_triangles = 0;  ///< number of flat triangles dropped (ConstrainedOptions::drop_flat)
    /// Indices of the holes that take no triangle away: outside of the hull, outside of ConstrainedOptions::keep, or where
    /// an earlier hole has taken all triangles.
    std::vector<std::size_t> idle_holes{};
    /// For each point of the input the point that stands for it in triangles and segments, which is itself if it was
    /// not merged. Empty without ConstrainedOptions::merge_distance.
    std::vector<std::uint32_t> merged_into{};
    DecompositionStats decomposition{};  ///< how points and segments were cut into pieces
};

/// Returns the constrained Delaunay triangulation: every segment is an edge or, where it runs through points, a chain
/// of edges; the other edges are locally Delaunay by the tie rule. Segments may overlap and repeat; those from a point
/// to itself are left out. The set of triangles is unique: it depends on the order of neither points nor segments
/// (except for the numbers of crossing points). Throws InputError for points as the plain triangulate() does, for
/// segments whose ends are not both among the points, for segments that cross unless Steiner points are inserted there
/// (place().segments), for holes outside the exact range (place().seeds), for segments if all points lie on one line,
/// and for segments that form no closed loops where they have to (place().points, place().segments). Throws OptionError
/// for a merge distance below 0 or above 1e60.
/// Source: M. V. Anglada, Computers & Graphics 21 (1997).
LAMINA_EXPORT ConstrainedTriangulation triangulate(std::span<const Point> points, std::span<const Segment> segments,
                                                   const ConstrainedOptions& options = {});

// ---- input ----

/// Returns for each point the point that stands for it: the first one at most `distance` away (rounded) that stands for
/// itself. So points that stand for themselves are more than `distance` apart. Takes O(n) on average, O(n log n) for
/// distance 0. Throws InputError for coordinates outside the exact range, OptionError for a distance below 0 or above
/// 1e60.
LAMINA_EXPORT std::vector<std::uint32_t> merge_points(std::span<const Point> points, double distance);

/// Returns the segments of closed rings of points: ring r holds the points from starts[r] on, up to the next ring or to
/// the last point. A ring may repeat its first point at its end, as in GeoJSON, where ConstrainedOptions::merge_distance
/// is given. Throws InputError for starts that do not ascend or exceed the number of points.
LAMINA_EXPORT std::vector<Segment> ring_segments(std::size_t points, std::span<const std::size_t> starts);

// ---- checks ----

/// Options of check_triangulation().
struct TriangulationCheckOptions {
    bool require_delaunay = true;  ///< whether edges that are no constraints must be locally Delaunay by the tie rule
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
