// Stage 5, decoupling: the region between layers and far field cut into pieces with frozen, graded borders.
// Source: J. K. Pardue, thesis (2015), chapter 5; L. Linardakis, N. Chrisochoides, SIAM J. Sci. Comput. 27 (2006).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// Frozen edges (separators, outer borders of layers) are at most this share of h long: refinement makes edges of
/// 0.82 h on average, and up to 1.24 sqrt(A) = 0.82 h no refinement vertex encroaches (docs/decisions/0003).
inline constexpr double frozen_share = 0.8;

/// How separators between pieces are discretised.
enum class SeparatorRule {
    equidistributed,  ///< equal shares of the integral of ds / h: no visible seam
    k_rule,           ///< thesis ch. 5, equation 1: k = 1/2 sqrt(A / sqrt 2)
};

enum class FarFieldShape {
    box,
    circle,
    convex,  ///< DecouplingOptions::outline
};

struct DecouplingOptions {
    FarFieldShape far_field_shape = FarFieldShape::box;
    double far_field = 100;      ///< half-width of the far-field box or radius of the circle, in chords
    std::vector<Point> outline;  ///< corners of a convex far field, counter-clockwise; else empty
    double chord = 1;            ///< extent in x of the whole configuration
    Point center;                ///< middle of the configuration
    SeparatorRule rule = SeparatorRule::equidistributed;
    double pieces_target = 50'000;  ///< triangles a piece, about
    double min_angle_deg = 20.7;
};

/// The box round the far field.
Box far_field_box(const DecouplingOptions& options);

/// A self-contained piece of work: refine(subdomain) needs nothing else, on a thread, on a rank or from a file.
struct Subdomain {
    std::vector<Point> points;      ///< border vertices
    std::vector<VertexId> global;   ///< their ids in Decoupling::points
    std::vector<Segment> segments;  ///< into points; region on the left
    SizeField size{1.0};
    double min_angle_deg = 20.7;
    double estimated_triangles = 0;
    bool lattice = true;  ///< RefineOptions::lattice: off where h grows so fast that looking for patches does not pay
};

struct Decoupling {
    /// The layer's points as they were, then separator and far-field vertices.
    std::vector<Point> points;
    std::vector<Segment> far_field;  ///< region on the left
    std::vector<Subdomain> subdomains;
    std::size_t separator_vertices = 0;
};

/// points: those of the layer. borders: closed loops of their ids, counter-clockwise, round each body and its layer.
/// Depends on the input alone, never on the number of threads. Throws UsageError for a far field that does not
/// enclose the borders with some room, or is not convex.
Decoupling decouple(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                    const SizeField& size, const DecouplingOptions& options);

/// The pure function behind the parallel outer region.
Refinement refine(const Subdomain& subdomain);

}  // namespace lamina
