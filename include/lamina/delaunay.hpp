// The Delaunay kernel as a library: plain and constrained triangulation, refinement, validation.
// Usable on its own; nothing here knows airfoils.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// Triangles index the points that were handed in (and, after refine(), the points added behind them).
struct Triangulation {
    std::vector<Triangle> triangles;  ///< counter-clockwise
};

/// Delaunay triangulation of distinct points, in any order; O(n log n) in practice. Cocircular points are fanned by
/// the one tie rule (predicates.hpp), so the set of triangles is unique and does not depend on the order of the points.
/// Large sets are triangulated by parallel_delaunay(); the result is the same on any number of threads, in the same
/// order. Fewer than three points, or all on one line: no triangles. Throws InputError for duplicates and for
/// coordinates outside the exact range. Source: biased randomised insertion order (Amenta, Choi, Rote, SoCG 2003) along
/// a Hilbert curve; cavity insertion (Bowyer 1981, Watson 1981).
Triangulation delaunay(std::span<const Point> points);

/// Where a decomposition ends. It depends on these and on the points alone, never on the number of threads.
struct DecompositionOptions {
    unsigned depth = 6;                 ///< most cuts on the way to a piece
    std::size_t leaf_vertices = 5'000;  ///< pieces of so few vertices are not cut further
};

struct DecompositionStats {
    std::size_t pieces = 0;
    std::size_t piece_vertices = 0;   ///< summed over pieces: vertices on paths count several times
    std::size_t largest_piece = 0;    ///< vertices
    std::size_t crossing_cuts = 0;    ///< cuts rejected because their path crossed a segment
    std::size_t unbalanced_cuts = 0;  ///< cuts rejected because one part was larger than 0.75 of the whole
    std::size_t uncut = 0;            ///< pieces that should have been cut further, but no cut would do
    std::size_t fallbacks = 0;        ///< regions triangulated in one piece because a piece could not be
};

/// The same triangles on several threads: the points are divided along paths of Delaunay edges, the pieces triangulated
/// by themselves. Throws the same errors.
/// Source: G. E. Blelloch, G. L. Miller, J. C. Hardwick, D. Talmor, Algorithmica 24 (1999); J. K. Pardue, thesis
/// (2015), chapter 4.
Triangulation parallel_delaunay(std::span<const Point> points, const DecompositionOptions& options = {});

/// What is kept of a constrained triangulation, before holes are cut.
enum class Keep {
    convex_hull,       ///< everything
    inside_segments,   ///< what cannot be reached from outside the hull without crossing a segment
    left_of_segments,  ///< what can be reached from the left side of a segment without crossing one: segments bound the
                       ///< region counter-clockwise outside and clockwise round holes
};

/// What happens where segments cross in their interiors.
enum class Crossings {
    refuse,  ///< InputError that names both
    insert,  ///< a point is added at each crossing, rounded to doubles; pieces bend by a rounding error and stay planar
};

struct ConstrainedOptions {
    Keep keep = Keep::convex_hull;
    Crossings crossings = Crossings::refuse;
    /// A point in each hole: what can be reached from it without crossing a segment is removed. Points outside the hull
    /// have no effect; one on a vertex or segment is an InputError.
    std::vector<Point> holes{};
};

/// Triangles and segments index the points handed in, then `added`.
struct ConstrainedTriangulation {
    std::vector<Point> added;         ///< crossing points
    std::vector<Triangle> triangles;  ///< counter-clockwise
    /// The edges of the triangles that are parts of segments, each once, directed as its segment is; in the order of
    /// the segments, each chain from a to b.
    std::vector<Segment> segments;
    std::vector<std::uint32_t> parents;  ///< for each of them the segment it is a part of, the first if several are
};

/// Constrained Delaunay triangulation: every segment is an edge or, where it runs through points, a chain of edges;
/// other edges are locally Delaunay by the tie rule. Segments may overlap or repeat. The set of triangles is unique: it
/// depends on neither the order of the points (except for how crossing points are numbered) nor that of the segments.
/// Throws InputError for duplicate points, crossing segments (naming their indices) unless they are to be resolved,
/// and segments where all points lie on one line.
/// Source: M. V. Anglada, Computers & Graphics 21 (1997).
ConstrainedTriangulation constrained_delaunay(std::span<const Point> points, std::span<const Segment> segments,
                                              const ConstrainedOptions& options = {});

struct RefineOptions {
    double min_angle_deg = 20.7;  ///< proved to terminate up to 20.7, measured up to 33
    /// The most points that may be added before giving up with MeshError.
    std::size_t max_points = 200'000'000;
    /// Fill large, evenly sized parts with patches of equilateral lattice and refine only the seams between them. Same
    /// guarantees; several times faster, and fewer triangles. Where it does not pay nothing changes.
    bool lattice = true;
    /// How many triangles to reserve memory for; a guess never changes the result.
    std::size_t expected_triangles = 0;
};

struct RefineStats {
    std::size_t refused = 0;      ///< points not placed because they would encroach upon the frozen border
    std::size_t below_bound = 0;  ///< triangles that stayed under the angle bound
    std::size_t exempt = 0;       ///< of those, at a corner below 60 degrees between two border edges
    std::size_t oversized = 0;    ///< triangles that stayed over the size bound
};

/// A triangulated piece: border points as given, then the points added.
struct Refinement {
    std::vector<Point> added;
    std::vector<Triangle> triangles;  ///< index i < border points: border; else added[i - border points]
    RefineStats stats;
};

/// Delaunay refinement of the region bounded by `segments` (region on their left) to a size field and a minimum angle.
/// The border is frozen: no segment is split, and a point that would encroach upon one is refused. A triangle is too
/// large where its area exceeds sqrt(3)/4 h^2, h being the mean of the size field at its vertices.
/// Deterministic: the result depends on the arguments alone.
/// Source: J. Ruppert, J. Algorithms 18 (1995); J. R. Shewchuk, Comput. Geom. 22 (2002); off-centres: A. Ungor, LATIN
/// 2004.
Refinement refine(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                  const RefineOptions& options = {});

/// Size field of the region that holds the seed, in the place of the general one.
struct RegionSize {
    Point seed;
    SizeField size;
};

struct ConstrainedRefineOptions {
    RefineOptions refine{};
    /// Split segments and the rim where the angle or size bound asks for it; otherwise they stay as they are, and
    /// triangles beside coarse ones may stay under the bounds.
    bool split_segments = true;
    std::vector<RegionSize> regions{};  ///< where several seeds lie in one region, the first counts
};

struct ConstrainedRefinement {
    /// Those of the triangulation, then points on segments and the rim (`added_on_edges` of them), then the rest.
    std::vector<Point> added;
    std::size_t added_on_edges = 0;
    std::vector<Triangle> triangles;     ///< index i < points: point i; else added[i - points]
    std::vector<std::uint32_t> regions;  ///< for each triangle the index of its RegionSize, or no_region
    std::vector<Segment> segments;       ///< as in ConstrainedTriangulation, split
    std::vector<std::uint32_t> parents;
    RefineStats stats;

    static constexpr std::uint32_t no_region = 0xffffffffu;
};

/// Refines a constrained triangulation of the points, inner segments and holes included: each part that segments
/// separate is refined by itself (in parallel; the result never depends on it) against borders that were split before:
/// until none exceeds the size field, none has a vertex it sees in its diametral circle, and no triangle is kept under
/// the bounds by one. Segments that meet at less than 90 degrees are split on common circles of powers of two round
/// their vertex. Triangles in a corner where segments meet at less than 60 degrees, and those whose shortest edge joins
/// two such segments, are exempt from the angle bound (stats.exempt).
/// Source: J. Ruppert, J. Algorithms 18 (1995), section 3 and "corner lopping"; G. Miller, S. Pav, N. Walkington, Int.
/// J. Comput. Geom. Appl. 15 (2005) for what is exempt.
ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                             const SizeField& size, const ConstrainedRefineOptions& options = {});

struct ValidateOptions {
    bool require_delaunay = true;  ///< locally Delaunay by the tie rule, but for edges in `constraints`
};

/// What is wrong with a triangulation of these points: indices out of range, clockwise or flat triangles, edges used
/// twice in one direction, triangles that overlap round a vertex, missing constraints, non-Delaunay edges.
/// Empty = valid. Exact.
std::vector<std::string> validate(std::span<const Point> points, std::span<const Triangle> triangles,
                                  std::span<const Segment> constraints = {}, const ValidateOptions& options = {});

}  // namespace lamina
