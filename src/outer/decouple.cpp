// The outer region cut into pieces: near-body box, rings of trapezoids, then cuts of whatever is still too large; every
// piece becomes a self-contained Subdomain.
// Source: J. K. Pardue, thesis (2015), chapter 5.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <lamina/decoupling.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/parallel.hpp"
#include "outer/cut.hpp"
#include "outer/piece.hpp"
#include "outer/skeleton.hpp"

namespace lamina {

namespace outer {
namespace {

Box box_around(std::span<const Point> points, std::span<const std::vector<VertexId>> borders) {
    Box box;
    for (const auto& border : borders)
        for (VertexId v : border) box.include(points[v.index()]);
    return box;
}

/// The largest box about the centre that all but touches the far field; the far field itself where that is a box.
Box inscribed_box(const DecouplingOptions& options) {
    const Box around = far_field_box(options);
    if (options.far_field_shape == FarFieldShape::box) return around;
    constexpr double room = 0.8;  // beyond the box's corners
    double half = 0;
    if (options.far_field_shape == FarFieldShape::circle) {
        half = options.far_field * options.chord / std::sqrt(2.0);
    } else {
        half = std::max(around.width(), around.height());
        for (std::size_t i = 0; i < options.outline.size(); ++i) {
            const Point a = options.outline[i], along = options.outline[(i + 1) % options.outline.size()] - a;
            half = std::min(half, cross(along, options.center - a) / (std::abs(along.x) + std::abs(along.y)));
        }
    }
    half *= room;
    return {options.center - Point{half, half}, options.center + Point{half, half}};
}

void require_convex(const DecouplingOptions& options) {
    if (options.far_field_shape != FarFieldShape::convex) return;
    const std::size_t n = options.outline.size();
    if (n < 3) throw UsageError("far field: an outline has three corners or more");
    for (std::size_t i = 0; i < n; ++i) {
        const Point a = options.outline[i], b = options.outline[(i + 1) % n], c = options.outline[(i + 2) % n];
        if (!(orient2d(a, b, c) > 0))
            throw UsageError(
                fmt::format("far field: the outline is not convex and counter-clockwise at ({}, {})", b.x, b.y));
        if (!(orient2d(a, b, options.center) > 0))
            throw UsageError("far field: the outline does not enclose the middle of the configuration");
    }
}

/// The shortest way from the box to the far field.
double room_around(const Box& bodies, const DecouplingOptions& options) {
    const Box around = far_field_box(options);
    double room = std::min({bodies.lower.x - around.lower.x, bodies.lower.y - around.lower.y,
                            around.upper.x - bodies.upper.x, around.upper.y - bodies.upper.y});
    for (Point corner : bodies.corners()) {
        if (options.far_field_shape == FarFieldShape::circle)
            room = std::min(room, options.far_field * options.chord - distance(corner, options.center));
        for (std::size_t i = 0; i < options.outline.size(); ++i) {
            const Point a = options.outline[i], along = options.outline[(i + 1) % options.outline.size()] - a;
            room = std::min(room, cross(along, corner - a) / length(along));
        }
    }
    return room;
}

/// The near-body box stands half the bodies' extent away from the layers. None where the far field leaves little room:
/// the corners of rings between boxes so near would be sharp.
std::optional<Box> near_body_box(const Box& bodies, const Box& outermost, const DecouplingOptions& options) {
    const double extent = std::max(bodies.width(), bodies.height());
    if (!(room_around(bodies, options) > 0.1 * extent))
        throw UsageError(
            fmt::format("far field of {} chords leaves no room around the bodies and their layers", options.far_field));
    const double room = std::min({bodies.lower.x - outermost.lower.x, bodies.lower.y - outermost.lower.y,
                                  outermost.upper.x - bodies.upper.x, outermost.upper.y - bodies.upper.y});
    if (room < 1.5 * extent) return std::nullopt;
    const double margin = 0.5 * extent;
    return Box{bodies.lower - Point{margin, margin}, bodies.upper + Point{margin, margin}};
}

Subdomain make_subdomain(const Skeleton& skeleton, const SizedPiece& sized, const SizeField& size,
                         double min_angle_deg) {
    Subdomain s;
    s.min_angle_deg = min_angle_deg;
    s.estimated_triangles = sized.triangles;
    s.lattice = sized.lattice;
    for (const auto& loop : sized.piece.loops) s.global.insert(s.global.end(), loop.begin(), loop.end());
    std::sort(s.global.begin(), s.global.end());
    s.global.erase(std::unique(s.global.begin(), s.global.end()), s.global.end());
    const auto local = [&](VertexId v) {
        return VertexId{
            static_cast<std::size_t>(std::lower_bound(s.global.begin(), s.global.end(), v) - s.global.begin())};
    };
    for (const auto& loop : sized.piece.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            s.segments.push_back({local(loop[i]), local(loop[i + 1 < loop.size() ? i + 1 : 0])});
    Box box;
    for (VertexId v : s.global) {
        s.points.push_back(skeleton.points[v.index()]);
        box.include(s.points.back());
    }
    s.size = size.restricted_to(box);
    return s;
}

}  // namespace
}  // namespace outer

Box far_field_box(const DecouplingOptions& options) {
    if (options.far_field_shape == FarFieldShape::convex) {
        Box box;
        for (Point p : options.outline) box.include(p);
        return box;
    }
    const double half = options.far_field * options.chord;
    return {options.center - Point{half, half}, options.center + Point{half, half}};
}

Decoupling decouple(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                    const SizeField& size, const DecouplingOptions& options) {
    outer::require_convex(options);
    const bool is_box = options.far_field_shape == FarFieldShape::box;
    const Box outermost = outer::inscribed_box(options);
    const auto near_body = outer::near_body_box(outer::box_around(points, borders), outermost, options);

    outer::Skeleton skeleton;
    skeleton.points.assign(points.begin(), points.end());
    for (const auto& border : borders)
        for (std::size_t i = 0; i < border.size(); ++i)
            skeleton.edges.push_back({border[i + 1 < border.size() ? i + 1 : 0], border[i]});
    std::vector<Segment> far_field_edges;
    if (near_body || is_box) {
        const Box innermost = near_body.value_or(outermost);
        const auto rings = outer::plan_rings(innermost, outermost, size, options.pieces_target);
        far_field_edges = outer::add_rings(skeleton, rings, innermost, outermost, size, options.rule, !is_box);
    }
    if (!is_box) far_field_edges = outer::add_outline(skeleton, options, size);

    const auto pieces = outer::cut_to_size(skeleton, outer::trace_pieces(skeleton.points, skeleton.edges), size,
                                           options.rule, options.pieces_target);
    Decoupling result;
    result.subdomains.resize(pieces.size());
    parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            result.subdomains[i] = outer::make_subdomain(skeleton, pieces[i], size, options.min_angle_deg);
    });
    result.separator_vertices = skeleton.points.size() - points.size();
    result.points = std::move(skeleton.points);
    result.far_field = std::move(far_field_edges);
    return result;
}

Refinement refine(const Subdomain& subdomain) {
    return refine(subdomain.points, subdomain.segments, subdomain.size,
                  {.min_angle_deg = subdomain.min_angle_deg,
                   .lattice = subdomain.lattice,
                   .expected_triangles = static_cast<std::size_t>(subdomain.estimated_triangles)});
}

}  // namespace lamina
