// Stages "decouple" and "refine": the outer region, between layers and far field, is cut into subdomains with frozen,
// graded borders, which are refined independently. Source: J. K. Pardue, thesis (2015), chapter 5; L. Linardakis, N.
// Chrisochoides, SIAM J. Sci. Comput. 27 (2006).
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/length.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// The shape of the outer boundary of the domain.
enum class FarFieldShape {
    box,      ///< a square
    circle,   ///< a circle
    outline,  ///< any convex polygon
};

/// Options of the far field.
struct FarFieldOptions {
    FarFieldShape shape = FarFieldShape::box;  ///< which of the other members count
    Length size = 100;                         ///< half-width of the box or radius of the circle
    std::vector<Point> outline{};              ///< corners of the polygon, counter-clockwise, in units of the input
    /// Height of a wind tunnel, whose floor and ceiling are slip walls: the box is as high as this. Its floor is the
    /// ground where there is one, and else the configuration is in the middle.
    std::optional<Length> tunnel{};
    std::optional<Length> ground{};  ///< distance of flat ground, a slip wall, below the lowest point
};

/// Throws OptionError where an option is out of range, and where the outline is no convex polygon.
LAMINA_EXPORT void validate(const FarFieldOptions& options);

/// Reads an outline "X0,Y0,X1,Y1,..." of three corners or more. Throws UsageError with the bare reason.
LAMINA_EXPORT std::vector<Point> parse_outline(const std::string& text);
/// Returns the text that parse_outline() reads back.
LAMINA_EXPORT std::string outline_text(std::span<const Point> corners);

/// The far field round a configuration, in units of the input.
struct FarField {
    FarFieldShape shape = FarFieldShape::box;  ///< which of the other members count
    Point center;                              ///< middle of the configuration
    double radius = 0;                         ///< half-width of the box or radius of the circle
    std::vector<Point> outline{};              ///< corners of the polygon
    double floor = -HUGE_VAL;                  ///< y of the slip wall below: ground, or the floor of a tunnel
    double ceiling = HUGE_VAL;                 ///< y of the slip wall above: the ceiling of a tunnel

    /// Returns the box round the far field.
    LAMINA_EXPORT Box box() const;
};

/// Places the far field round the box of all bodies; `chord` is the reference chord. Throws OptionError where an option
/// is out of range, where an outline does not enclose the middle of that box, and where a tunnel does not enclose it.
LAMINA_EXPORT FarField place_far_field(const Box& bodies, double chord, const FarFieldOptions& options = {});

/// Options of the stage "decouple".
struct DecouplingOptions {
    double pieces_target = 50'000;  ///< target number of triangles per subdomain
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const DecouplingOptions& options);

/// A part of the outer region that is refined by itself: refine(subdomain) needs nothing else, whether it runs on
/// another thread, in another process or from a file.
struct Subdomain {
    std::vector<Point> points;       ///< border vertices
    std::vector<VertexId> global;    ///< their ids in Decoupling::points, ascending
    std::vector<Segment> segments;   ///< border edges between indices into points; the subdomain lies on their left
    SizeField size{1.0};             ///< the size field, restricted to the box round the subdomain
    RefineOptions refine;            ///< the options given, with the estimate and whether a lattice may pay
    double estimated_triangles = 0;  ///< number of triangles that refinement will make, by estimate
};

/// The outer region, cut into subdomains.
struct Decoupling {
    std::vector<Point> points;           ///< the points handed in, then the vertices of separators and far field
    std::vector<Segment> far_field;      ///< edges of the far field; the region lies on their left
    std::vector<Subdomain> subdomains;   ///< in an order that does not depend on the number of threads
    std::size_t separator_vertices = 0;  ///< number of vertices of separators and far field
};

/// Cuts the outer region, between the borders of the layers and the far field, into subdomains of about equal work.
/// `borders` are closed loops of indices into `points`, counter-clockwise round each body and its layer. The subdomains
/// depend on the arguments alone, never on the number of threads. Throws OptionError for options out of range, and
/// where the far field does not enclose the borders with some room.
LAMINA_EXPORT Decoupling decouple(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                                  const SizeField& size, const FarField& far_field,
                                  const DecouplingOptions& options = {}, const RefineOptions& refine = {});

/// Returns the number of triangles that the refinement of the outer region will make, by estimate, before it is cut
/// into subdomains. Takes the arguments of decouple() and a few milliseconds. Throws OptionError where the far field
/// does not enclose the borders with some room.
LAMINA_EXPORT double estimate_triangles(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                                        const SizeField& size, const FarField& far_field);

/// Refines one subdomain. Throws as refine(points, segments, size, options) does.
LAMINA_EXPORT Refinement refine(const Subdomain& subdomain);

/// Refines all subdomains in parallel, the largest first. The results stand in the order of the subdomains.
LAMINA_EXPORT std::vector<Refinement> refine(std::span<const Subdomain> subdomains);

}  // namespace lamina
