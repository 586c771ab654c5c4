// Delaunay refinement of triangulations to sizes and angles, and smoothing. It can be built and used by itself
// (docs/library.md). h is the mean of the sizes at the vertices of a triangle.
//
// Guarantees:
//  1. Edges are h long on average: within 3 % where border edges are h long and h grows by up to 0.1 per unit of
//     distance.
//  2. No circumcircle exceeds that of the equilateral triangle of edge max_circle_ratio x h, no area exceeds
//     max_area_ratio times that of one of edge h, and no angle is below the bound, but for what RefineStats counts.
//  3. Steiner points follow the points handed in, which keep their numbers. Triangles are counter-clockwise.
//  4. The result depends on the arguments alone, never on the number of threads.
// Limits:
//  1. The work is proved to end up to proved_min_angle_deg where no input angle is below 60 degrees; up to
//     max_min_angle_deg, and for input angles down to 1 degree, it has ended in all trials.
//  2. OptionError for options out of range, InputError as triangulate() throws it, MeshError beyond max_points.
// Example:
//     const std::vector<Point> points{{0, 0}, {2, 0}, {2, 1}, {0, 1}};
//     const ConstrainedTriangulation coarse = triangulate(points, std::vector<Segment>{});
//     const ConstrainedRefinement fine = refine(points, coarse, SizeField(0.1), {.refine = {.min_angle_deg = 28}});
//     assert(fine.stats.below_bound == 0 && fine.stats.oversized == 0);
//     assert(fine.triangles.size() > 350 && fine.triangles.size() < 600);  // 462 would be equilateral
//
// Source: J. Ruppert, J. Algorithms 18 (1995), section 3 and "corner lopping"; lenses: J. R. Shewchuk, Comput. Geom. 22
// (2002); off-centres: A. Ungor, LATIN 2004; frontal refinement: D. Engwirda, D. Ivers, Computer-Aided Design 72
// (2016); exempt triangles: G. Miller, S. Pav, N. Walkington, Int. J. Comput. Geom. Appl. 15 (2005).
#pragma once

#include <functional>

#include <lamina/angle_bounds.hpp>
#include <lamina/sizing.hpp>
#include <lamina/triangulation.hpp>

namespace lamina {

LAMINA_EXPORT void validate(const DecompositionOptions& options);  ///< throws OptionError: an option out of range

/// The largest circumcircle of a triangle, over that of the equilateral triangle of edge h.
inline constexpr double max_circle_ratio = 1.3;

/// Options of refinement.
struct RefineOptions {
    double min_angle_deg = proved_min_angle_deg;  ///< smallest angle of a triangle; 0: no bound
    std::size_t max_points = 200'000'000;         ///< number of Steiner points beyond which refine() throws MeshError
    bool stop_at_max_points = false;  ///< whether it returns what it has then, RefineStats::stopped being set
    /// Largest area of a triangle, over that of the equilateral triangle of edge h. Where the area matters more than
    /// the mean edge, sizes of size_for_area() with a ratio nearer to 1 make fewer triangles, which are less regular.
    double max_area_ratio = max_circle_ratio * max_circle_ratio;
    /// How often all vertices move to the means of their neighbours at the end; those of bad triangles more often.
    unsigned smoothing = 2;
    /// Whether, after that, vertices near those without six neighbours are merged, split and joined otherwise: the most
    /// regular triangles, in some fifty times the time. For frozen borders alone, and without lattices.
    bool regularize = false;
    /// Whether large, evenly sized parts are filled with patches of an equilateral lattice, so that only the seams
    /// between them are refined: several times faster, and more regular. It changes nothing where it does not pay.
    bool lattice = true;
    /// A length that scales with the domain, such as a chord; empty: the unit of the coordinates. Sizes are held as
    /// multiples of it, so that domain, sizes and unit may be scaled together without other roundings.
    std::optional<double> unit_length{};
    std::size_t expected_triangles = 0;  ///< that memory is reserved for; 0: an estimate. Never changes the result
};

LAMINA_EXPORT void validate(const RefineOptions& options);  ///< throws OptionError: an option out of range

/// The numbers of triangles that could not be refined as requested.
struct RefineStats {
    std::size_t refused = 0;      ///< points not placed because of rounding or of a border that cannot be split, if any
                                  ///< triangles but exempt ones stayed beyond the bounds for it
    std::size_t below_bound = 0;  ///< triangles that stayed below the angle bound
    std::size_t exempt = 0;       ///< those of them that no refinement could mend: see the functions
    std::size_t oversized = 0;    ///< triangles that stayed above the size bound
    bool stopped = false;         ///< whether refinement ended because max_points did not suffice

    /// Adds the numbers of another region.
    LAMINA_EXPORT RefineStats& operator+=(const RefineStats& other);
};

/// A refined region.
struct Refinement {
    std::vector<Point> steiner_points;  ///< the points that refinement placed
    std::vector<Triangle> triangles;    ///< counter-clockwise
    RefineStats stats;                  ///< what could not be refined
};

/// Refines the region on the left of `segments`, which are frozen: none is split, and a point that would encroach upon
/// one is refused. Triangles at a corner below 60 degrees between two of them are exempt from the angle bound.
LAMINA_EXPORT Refinement refine(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                                const RefineOptions& options = {});

/// A size field that replaces the general one in the region that holds the seed.
struct RegionSize {
    Point seed;      ///< a point inside the region
    SizeField size;  ///< the size field there
};

/// Options of the refinement of a constrained triangulation.
struct ConstrainedRefineOptions {
    RefineOptions refine{};      ///< the options of every region
    bool split_segments = true;  ///< whether segments and the boundary are split where a bound demands it
    /// Whether they are split until no vertex lies in the diametral circle of any part, so that all triangles are
    /// Delaunay and not only constrained Delaunay (Triangle's -D). With an angle bound of 0, no smoothing and sizes
    /// that are HUGE_VAL it makes a conforming Delaunay triangulation and nothing else.
    bool conforming = false;
    std::vector<RegionSize> regions{};  ///< where several seeds lie in one region, the first counts
};

/// A refined constrained triangulation.
struct ConstrainedRefinement {
    std::vector<Point> steiner_points;   ///< those of the triangulation, those on segments and the boundary, the rest
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
/// degrees less twice the angle bound, and where they keep a triangle beyond the bounds; those that meet at less than
/// 90 degrees on common circles round their vertex. Exempt from the angle bound are triangles
///  - in a corner where segments meet at less than 60 degrees, and those whose shortest edge joins two such segments;
///  - of a vertex closer to a segment than 1e-13 of the segment's coordinates, or of two vertices closer to each other
///    than 1e-15 of theirs;
///  - between segments that run beside each other for at least 1e4 times their distance, unless `conforming` holds.
LAMINA_EXPORT ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                                           const SizeField& size, const ConstrainedRefineOptions& options = {});

/// A size at each point of the plane, in units of the input: positive, HUGE_VAL where there is no bound. It may jump.
using SizeFunction = std::function<double(Point)>;

/// Refines to the sizes of any function, without lattices. It is called on one thread at a time, several times a
/// triangle. Throws InputError, too, for sizes that are not positive (place().at), and what the function throws.
LAMINA_EXPORT ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                                           const SizeFunction& size, const ConstrainedRefineOptions& options = {});
/// Returns the function that is linear in the triangles of a background mesh, which it copies, with these sizes at its
/// points; HUGE_VAL outside. Throws InputError as TriangulationIndex does, and unless each point has a positive size.
LAMINA_EXPORT SizeFunction sizes_of_mesh(std::span<const Point> points, std::span<const Triangle> triangles,
                                         std::span<const double> sizes);
/// Returns the function that bounds the areas of triangles inside each triangle of a mesh: size_for_area() of its
/// bound, HUGE_VAL where the bound is not positive, and outside; the smallest one on edges and vertices. It takes
/// RefineOptions::max_area_ratio. Throws as sizes_of_mesh() does.
LAMINA_EXPORT SizeFunction sizes_of_areas(std::span<const Point> points, std::span<const Triangle> triangles,
                                          std::span<const double> areas, double max_area_ratio);
/// Returns a triangulation from elsewhere as one that refine() takes (Triangle's -r): edges that are no segments are
/// flipped until the triangulation is constrained Delaunay. `merged_into` says which point stands for which
/// (ConstrainedTriangulation), for ends of segments; where it is empty, equal points stand for those in no triangle.
/// Throws InputError for triangles as half_edges() does and for those that are not counter-clockwise
/// (place().triangles), for segments that are no edges (place().segments), and for a `merged_into` of another size.
LAMINA_EXPORT ConstrainedTriangulation constrain_triangles(std::span<const Point> points,
                                                           std::span<const Triangle> triangles,
                                                           std::span<const Segment> segments = {},
                                                           std::span<const std::uint32_t> merged_into = {});

/// The triangles that a refinement of a constrained triangulation will make, by estimate.
struct RefinementEstimate {
    double by_sizes = 0;         ///< as many as there are, or as the sizes ask for: right within a few percent
    double by_angles = 0;        ///< as many as the angle bound asks for without sizes: right within a factor of three
    double least_by_angles = 0;  ///< below it the angle bound hardly ever lets the refinement stay: a limit to enforce

    /// Returns the likely number.
    double triangles() const { return by_sizes < by_angles ? by_angles : by_sizes; }
};

/// Estimates the triangles of this refinement, in less time than it takes to triangulate.
LAMINA_EXPORT RefinementEstimate estimate_triangles(std::span<const Point> points,
                                                    const ConstrainedTriangulation& triangulation,
                                                    const SizeField& size,
                                                    const ConstrainedRefineOptions& options = {});

/// Options of optimize().
struct OptimizeOptions {
    double min_angle_deg = 0;      ///< no move makes a triangle with a smaller angle; 0: no bound
    unsigned rounds = 2;           ///< how often all vertices move; those of ill-shaped triangles move a few times more
    std::size_t fixed_points = 0;  ///< the first so many points stay where they are
};

/// A triangulation whose vertices have moved.
struct OptimizedTriangulation {
    std::vector<Point> points;        ///< as many as there were, in the same order
    std::vector<Triangle> triangles;  ///< as many as there were, counter-clockwise
};

/// Moves the vertices of a triangulation to the means of their neighbours, where that does not make the worst triangle
/// round them worse, and flips edges, so that it stays constrained Delaunay. Points that are fixed, on segments or on
/// the boundary do not move. refine() does this by itself (RefineOptions::smoothing). Precondition:
/// check_triangulation() finds no defect. Throws OptionError for an angle above max_min_angle_deg or below 0,
/// InputError for indices out of range. Source: L. R. Herrmann, J. Eng. Mech. Div. ASCE 102 (1976); L. A. Freitag, C.
/// Ollivier-Gooch, Int. J. Numer. Meth. Engng. 40 (1997).
LAMINA_EXPORT OptimizedTriangulation optimize(std::span<const Point> points, std::span<const Triangle> triangles,
                                              std::span<const Segment> segments = {},
                                              const OptimizeOptions& options = {});

}  // namespace lamina
