// The outer region cut into pieces: near-body box, rings of trapezoids, then cuts of whatever is still too large; every
// piece becomes a self-contained Subdomain.
// Source: J. K. Pardue, thesis (2015), chapter 5.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <lamina/decoupling.hpp>
#include <lamina/error.hpp>

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

/// The near-body box stands half the bodies' extent away from the layers. Where the far field leaves little room it is
/// the far field itself: the corners of rings between boxes so near would be sharp.
Box near_body_box(const Box& bodies, const Box& far_field, const DecouplingOptions& options) {
    const double room = std::min({bodies.lower.x - far_field.lower.x, bodies.lower.y - far_field.lower.y,
                                  far_field.upper.x - bodies.upper.x, far_field.upper.y - bodies.upper.y});
    const double extent = std::max(bodies.width(), bodies.height());
    if (!(room > 0.1 * extent))
        throw UsageError(
            fmt::format("far field of {} chords leaves no room around the bodies and their layers", options.far_field));
    if (room < 1.5 * extent) return far_field;
    const double margin = 0.5 * extent;
    return {bodies.lower - Point{margin, margin}, bodies.upper + Point{margin, margin}};
}

Subdomain make_subdomain(const Skeleton& skeleton, const SizedPiece& sized, const SizeField& size,
                         double min_angle_deg) {
    Subdomain s;
    s.min_angle_deg = min_angle_deg;
    s.estimated_triangles = sized.triangles;
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
    const double half = options.far_field * options.chord;
    return {options.center - Point{half, half}, options.center + Point{half, half}};
}

Decoupling decouple(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                    const SizeField& size, const DecouplingOptions& options) {
    const Box far_field = far_field_box(options);
    const Box near_body = outer::near_body_box(outer::box_around(points, borders), far_field, options);

    outer::Skeleton skeleton;
    skeleton.points.assign(points.begin(), points.end());
    for (const auto& border : borders)
        for (std::size_t i = 0; i < border.size(); ++i)
            skeleton.edges.push_back({border[i + 1 < border.size() ? i + 1 : 0], border[i]});
    const auto rings = outer::plan_rings(near_body, far_field, size, options.pieces_target);
    auto far_field_edges = outer::add_rings(skeleton, rings, near_body, far_field, size, options.rule);

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
                   .expected_triangles = static_cast<std::size_t>(subdomain.estimated_triangles)});
}

}  // namespace lamina
