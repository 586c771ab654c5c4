// The stages "decouple" and "refine": the outer region, between layers and far field, is cut into subdomains with
// frozen, graded borders, which are refined independently. Source: J. K. Pardue, thesis (2015), chapter 5; L.
// Linardakis, N. Chrisochoides, SIAM J. Sci. Comput. 27 (2006).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/delaunay.hpp>
#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "decoupling/far_field.hpp"

namespace lamina::decoupling {

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

/// Straight lines inside the outer region that become edges of the mesh, as separators do. They meet each other and the
/// borders at vertices alone.
struct InnerLines {
    std::vector<Point> points;   ///< vertices on no border; their numbers follow those of the region's points
    std::vector<Segment> lines;  ///< between vertices
};

/// The outer region with what decides how it is cut. `borders` are closed loops of indices into `points`,
/// counter-clockwise round each body and its layer. If the far field has walls, the last one is the border of the
/// domain, clockwise.
struct OuterRegion {
    std::span<const Point> points;
    std::span<const std::vector<VertexId>> borders;
    const SizeField& size;
    const FarField& far_field;
    DecouplingOptions options{};
    InnerLines inner{};  ///< lines inside it that become edges of the mesh
};

/// The outer region, cut into subdomains.
struct Decoupling {
    std::vector<Point> points;           ///< the points handed in, then the vertices of separators and far field
    std::vector<Segment> far_field;      ///< edges of the far field, unless it has walls; the region lies on their left
    std::vector<Subdomain> subdomains;   ///< in an order that does not depend on the number of threads
    std::size_t separator_vertices = 0;  ///< number of vertices of separators and far field
    std::vector<std::vector<Segment>> inner_edges{};  ///< per line inside the region: its edges, in its direction
};

/// Cuts the outer region, between the borders of the layers and the far field, into subdomains of about equal work.
/// They depend on the arguments alone, never on the number of threads. Throws OptionError for options out of range, and
/// where the far field does not enclose the borders and the inner lines with some room.
LAMINA_EXPORT Decoupling decouple(const OuterRegion& region, const RefineOptions& refine = {});

/// Returns the number of triangles that the refinement of the outer region will make, by estimate, before it is cut
/// into subdomains; lines inside it are left out. Takes a few milliseconds. Throws OptionError where the far field does
/// not enclose the borders with some room.
LAMINA_EXPORT double estimate_triangles(const OuterRegion& region);

/// Refines one subdomain. Throws as refine(points, segments, size, options) does.
LAMINA_EXPORT Refinement refine(const Subdomain& subdomain);

/// Refines all subdomains in parallel, the largest first. The results stand in the order of the subdomains.
LAMINA_EXPORT std::vector<Refinement> refine(std::span<const Subdomain> subdomains);

}  // namespace lamina::decoupling
