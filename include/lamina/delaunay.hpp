// Delaunay triangulation, constrained triangulation and refinement. This part of the library can be built and used by
// itself; it knows no airfoils (docs/library.md).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <lamina/angle_bounds.hpp>
#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>
#include <lamina/triangulation.hpp>

namespace lamina {

// ---- options of decompositions (triangulation.hpp) ----

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const DecompositionOptions& options);

// ---- refinement ----

/// The circumcircles of refined triangles are at most as large as that of the equilateral triangle whose edge is this
/// times the mean of h at the vertices.
inline constexpr double max_circle_ratio = 1.3;

/// Options of refinement.
struct RefineOptions {
    /// Smallest angle of a triangle; 0: no bound. Refinement is proved to end up to the default, and has ended in all
    /// trials up to max_min_angle_deg.
    double min_angle_deg = proved_min_angle_deg;
    std::size_t max_points = 200'000'000;  ///< number of Steiner points beyond which refine() throws MeshError
    /// Whether refine() returns what it has at max_points (RefineStats::stopped) instead of throwing. Triangles that are
    /// too large have been mended first, from the border inwards.
    bool stop_at_max_points = false;
    /// Largest area of a triangle, over that of the equilateral triangle whose edge is the mean of h at its vertices.
    /// The default follows from max_circle_ratio. Where a bound of the area matters more than the mean edge, sizes of
    /// size_for_area() with a ratio nearer to 1 make fewer triangles of a given largest area, which are less regular.
    double max_area_ratio = max_circle_ratio * max_circle_ratio;
    /// How often all vertices move to the means of their neighbours once triangles are made. The vertices of ill-shaped
    /// triangles then move a few times more. 0: none moves.
    unsigned smoothing = 2;
    /// Whether, after that, vertices near those without six neighbours are merged, split and joined otherwise, where that
    /// makes triangles more equilateral: the most regular triangles, in some fifty times the time. Lattices are not used
    /// then. It concerns refinement with frozen borders alone.
    bool regularize = false;
    /// Whether large, evenly sized parts are filled with patches of an equilateral lattice, so that only the seams
    /// between them are refined. The guarantees are the same, refinement is several times faster, and triangles are
    /// more regular. It changes nothing where it does not pay.
    bool lattice = true;
    /// A length that scales with the domain, such as the chord of a section. Sizes are held in single precision as
    /// multiples of it, and short edges are sorted by them, so that domain, sizes and unit may be scaled together
    /// without other roundings. Empty: the unit of the coordinates.
    std::optional<double> unit_length{};
    /// Number of triangles that memory is reserved for; 0: an estimate. It never changes the result.
    std::size_t expected_triangles = 0;
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const RefineOptions& options);

/// The numbers of triangles that could not be refined as requested.
struct RefineStats {
    /// Points that were not placed because a border would be too near that cannot be split; 0 if that left no triangle
    /// beyond the bounds but exempt ones.
    std::size_t refused = 0;
    std::size_t below_bound = 0;  ///< triangles that stayed below the angle bound
    /// Triangles of `below_bound` at a corner below 60 degrees between two border edges, or, where segments may be split,
    /// within rounding of a segment or between segments that nearly coincide.
    std::size_t exempt = 0;
    std::size_t oversized = 0;  ///< triangles that stayed above the size bound
    bool stopped = false;       ///< whether refinement ended because max_points did not suffice

    /// Adds the numbers of another region.
    LAMINA_EXPORT RefineStats& operator+=(const RefineStats& other);
};

/// A refined region. Triangles index the points of the input, followed by `steiner_points`.
struct Refinement {
    std::vector<Point> steiner_points;  ///< the points that refinement placed
    std::vector<Triangle> triangles;    ///< counter-clockwise
    RefineStats stats;                  ///< what could not be refined
};

/// Refines the region on the left of `segments` to a size field and a minimum angle. The border is frozen: no segment
/// is split, and a point that would encroach upon one is refused. A triangle is too large where its circumcircle or its
/// area exceeds the bounds of max_circle_ratio and RefineOptions::max_area_ratio. Edges are h long on average, within
/// 3 % where h grows by up to 0.1 per unit of distance and border edges are h long. The result depends on the arguments
/// alone. Throws OptionError for options out of range, InputError as triangulate() does, MeshError where max_points do
/// not suffice.
/// Source: J. Ruppert, J. Algorithms 18 (1995); J. R. Shewchuk, Comput. Geom. 22 (2002); off-centres: A. Ungor, LATIN
/// 2004; frontal refinement: D. Engwirda, D. Ivers, Computer-Aided Design 72 (2016).
LAMINA_EXPORT Refinement refine(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                                const RefineOptions& options = {});

/// A size field that replaces the general one in the region that holds the seed.
struct RegionSize {
    Point seed;      ///< a point inside the region
    SizeField size;  ///< the size field there
};

/// Options of the refinement of a constrained triangulation.
struct ConstrainedRefineOptions {
    RefineOptions refine{};  ///< the options of every region
    /// Whether segments and the boundary are split where the angle or size bound demands it. If not, triangles beside
    /// long segments may stay beyond the bounds.
    bool split_segments = true;
    /// Whether segments and the boundary are split until no vertex lies in the diametral circle of any part, so that all
    /// triangles are Delaunay and not only constrained Delaunay (Triangle's -D). With an angle bound of 0, no smoothing
    /// and a size that is HUGE_VAL everywhere it makes a conforming Delaunay triangulation and nothing else.
    bool conforming = false;
    std::vector<RegionSize> regions{};  ///< where several seeds lie in one region, the first counts
};

/// A refined constrained triangulation. Triangles index the points of the input, followed by `steiner_points`.
struct ConstrainedRefinement {
    /// The Steiner points of the triangulation, then those on segments and the boundary, then the rest.
    std::vector<Point> steiner_points;
    std::size_t on_segments = 0;         ///< number of Steiner points on segments and the boundary
    std::vector<Triangle> triangles;     ///< counter-clockwise
    std::vector<std::uint32_t> regions;  ///< for each triangle the index of its RegionSize, or no_region
    std::vector<Segment> segments;       ///< the segments of the triangulation, split
    std::vector<std::uint32_t> parents;  ///< as in ConstrainedTriangulation
    RefineStats stats;                   ///< what could not be refined

    /// The entry of `regions` for a triangle in no region with a size field of its own.
    static constexpr std::uint32_t no_region = 0xffffffffu;
};

/// Refines a constrained triangulation of the points, with its inner segments and holes. Segments and the boundary are
/// split where they are too long for the size field, where a vertex lies in the lens from which they appear at 180
/// degrees less twice the angle bound, and where they keep a triangle beyond the bounds. Segments that meet at less
/// than 90 degrees are split on common circles round their vertex, whose radii are powers of two. Triangles in a corner
/// where segments meet at less than 60 degrees, and those whose shortest edge joins two such segments, are exempt from
/// the angle bound (stats.exempt). A segment that others divide counts as a whole, and so do segments that continue each
/// other straight on. Exempt, too, are triangles of a vertex closer to a segment than 1e-13 of the segment's coordinates,
/// of two vertices closer to each other than 1e-15 of theirs, and, unless ConstrainedRefineOptions::conforming holds,
/// triangles between segments that run beside each other for at least 1e4 times their distance: nothing is split for
/// their sake. Without rounding, no other angle stays below it: stats.refused counts the triangles that rounding, or split_segments = false,
/// kept from being mended. Throws as the other refine() does. Source: J. Ruppert, J. Algorithms 18 (1995), section 3 and
/// "corner lopping"; lenses: J. R. Shewchuk, Comput. Geom. 22 (2002); exempt triangles: G. Miller, S. Pav, N. Walkington,
/// Int. J. Comput. Geom. Appl. 15 (2005).
LAMINA_EXPORT ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                                           const SizeField& size, const ConstrainedRefineOptions& options = {});

/// A size at each point of the plane, in units of the input: positive, HUGE_VAL where there is no bound.
using SizeFunction = std::function<double(Point)>;

/// Refines to the sizes of any function. It is called on one thread at a time, several times a triangle. Sizes may jump.
/// All that refine() to a size field promises holds, but no lattice speeds it up. Throws InputError, too, where the
/// function returns a number that is not positive (place().at), and what the function throws.
LAMINA_EXPORT ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                                           const SizeFunction& size, const ConstrainedRefineOptions& options = {});

/// Returns the function that is linear in the triangles of a background mesh and has these sizes at its points; HUGE_VAL
/// outside. The function holds a copy of the mesh. Throws InputError as TriangulationIndex does, and for sizes that are
/// not positive or not one for each point.
LAMINA_EXPORT SizeFunction sizes_of_mesh(std::span<const Point> points, std::span<const Triangle> triangles,
                                         std::span<const double> sizes);

/// Returns the function that bounds the areas of triangles inside each triangle of a mesh: sizes are size_for_area() of
/// its area bound, HUGE_VAL where the bound is not positive, and outside; the smallest one on edges and vertices. So
/// a triangle whose corners all lie in one triangle of the mesh exceeds the bound of that triangle nowhere, where
/// RefineOptions::max_area_ratio is as given here. Throws InputError as TriangulationIndex does, and unless there is one
/// area for each triangle.
LAMINA_EXPORT SizeFunction sizes_of_areas(std::span<const Point> points, std::span<const Triangle> triangles,
                                          std::span<const double> areas, double max_area_ratio);

/// Returns a triangulation from elsewhere as one that refine() takes (Triangle's -r): edges that are no segments are
/// flipped until the triangulation is constrained Delaunay. Triangles keep their number, not their order. `merged_into`
/// says which point stands for which (ConstrainedTriangulation), and ends of segments may be points that others stand
/// for; where it is empty, equal points stand for ends that are in no triangle. Throws InputError for points as
/// triangulate() does, for triangles as half_edges() does and for those that are not counter-clockwise
/// (place().triangles), for segments that are no edges of triangles (place().segments), and where `merged_into` is
/// neither empty nor one index for each point.
LAMINA_EXPORT ConstrainedTriangulation constrain_triangles(std::span<const Point> points,
                                                           std::span<const Triangle> triangles,
                                                           std::span<const Segment> segments = {},
                                                           std::span<const std::uint32_t> merged_into = {});

/// The triangles that a refinement of a constrained triangulation will make, by estimate.
struct RefinementEstimate {
    double by_sizes = 0;   ///< as many as there are, or as the sizes ask for: right within a few percent
    double by_angles = 0;  ///< as many as the angle bound asks for without any sizes: right within a factor of three
    /// The number below which the angle bound hardly ever lets the refinement stay. A limit may be enforced by it.
    double least_by_angles = 0;

    /// Returns the likely number.
    double triangles() const { return by_sizes < by_angles ? by_angles : by_sizes; }
};

/// Estimates the triangles of this refinement, in less time than it takes to triangulate.
LAMINA_EXPORT RefinementEstimate estimate_triangles(std::span<const Point> points,
                                                    const ConstrainedTriangulation& triangulation,
                                                    const SizeField& size,
                                                    const ConstrainedRefineOptions& options = {});

// ---- smoothing ----

/// Options of optimize().
struct OptimizeOptions {
    /// No move makes a triangle with a smaller angle. 0: no bound.
    double min_angle_deg = 0;
    /// How often all vertices move. Those of ill-shaped triangles then move a few times more.
    unsigned rounds = 2;
    std::size_t fixed_points = 0;  ///< the first so many points stay where they are
};

/// A triangulation whose vertices have moved.
struct OptimizedTriangulation {
    std::vector<Point> points;        ///< as many as there were, in the same order
    std::vector<Triangle> triangles;  ///< as many as there were, counter-clockwise
};

/// Moves the vertices of a triangulation to the means of their neighbours, where that does not make the worst triangle
/// round them worse, and flips edges, so that the triangulation stays constrained Delaunay. Points that are fixed, on
/// segments or on the boundary do not move. refine() does this by itself (RefineOptions::smoothing); here are triangles
/// from elsewhere, or for which more time is to be spent. Precondition: check_triangulation() finds no defect. Throws
/// OptionError for an angle above max_min_angle_deg or below 0, InputError as triangulate() does and for indices out of
/// range. Source: L. R. Herrmann, J. Eng. Mech. Div. ASCE 102 (1976); L. A. Freitag, C. Ollivier-Gooch, Int. J. Numer.
/// Meth. Engng. 40 (1997).
LAMINA_EXPORT OptimizedTriangulation optimize(std::span<const Point> points, std::span<const Triangle> triangles,
                                              std::span<const Segment> segments = {},
                                              const OptimizeOptions& options = {});

}  // namespace lamina
