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
/// Fewer than three points, or all on one line: no triangles. Throws InputError for duplicates and for coordinates
/// outside the exact range.
/// Source: biased randomised insertion order (Amenta, Choi, Rote, SoCG 2003) along a Hilbert curve; cavity insertion
/// (Bowyer 1981, Watson 1981).
Triangulation delaunay(std::span<const Point> points);

/// What is kept of a constrained triangulation.
enum class Keep {
    convex_hull,       ///< everything
    left_of_segments,  ///< what can be reached from the left side of a segment without crossing one: segments bound the
                       ///< region counter-clockwise outside and clockwise round holes
};

struct ConstrainedOptions {
    Keep keep = Keep::convex_hull;
};

/// Constrained Delaunay triangulation: every segment is an edge; other edges are locally Delaunay by the tie rule.
/// Segments may meet at end points only. Throws InputError for duplicates, crossing segments and segments through
/// vertices (naming their indices).
Triangulation constrained_delaunay(std::span<const Point> points, std::span<const Segment> segments,
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

struct ValidateOptions {
    bool require_delaunay = true;  ///< locally Delaunay by the tie rule, but for edges in `constraints`
};

/// What is wrong with a triangulation of these points: indices out of range, clockwise or flat triangles, edges used
/// twice in one direction, overlap (signed area of the boundary), missing constraints, non-Delaunay edges.
/// Empty = valid. Exact.
std::vector<std::string> validate(std::span<const Point> points, std::span<const Triangle> triangles,
                                  std::span<const Segment> constraints = {}, const ValidateOptions& options = {});

}  // namespace lamina
