// The outer region becomes subdomains: near-body box and rings of trapezoids first, then cuts of all subdomains that
// are still too large. Source: J. K. Pardue, thesis (2015), chapter 5.
#include <lamina/decoupling.hpp>

#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "decoupling/border_triangulation.hpp"
#include "decoupling/cut_to_size.hpp"
#include "decoupling/far_field.hpp"
#include "decoupling/rings.hpp"
#include "decoupling/separators.hpp"
#include "decoupling/skeleton.hpp"
#include "decoupling/subdomain_border.hpp"

namespace lamina::decoupling {

namespace {

/// Returns the box round all borders.
Box box_round(std::span<const Point> points, std::span<const std::vector<VertexId>> borders) {
    Box box;
    for (const std::vector<VertexId>& border : borders)
        for (const VertexId v : border) box.include(points[v.index()]);
    return box;
}

/// Starts a skeleton with the borders of the layers, turned clockwise: the outer region lies on their left.
Skeleton start_skeleton(std::span<const Point> points, std::span<const std::vector<VertexId>> borders) {
    Skeleton skeleton;
    skeleton.points.assign(points.begin(), points.end());
    for (const std::vector<VertexId>& border : borders)
        for (std::size_t i = 0; i < border.size(); ++i)
            skeleton.edges.push_back({border[i + 1 < border.size() ? i + 1 : 0], border[i]});
    return skeleton;
}

Subdomain make_subdomain(const Skeleton& skeleton, const EstimatedBorder& estimated, const SizeField& size,
                         const RefineOptions& refine) {
    LocalBorder border = localize(estimated.border, skeleton.points);
    Box box;
    for (const Point p : border.points) box.include(p);
    Subdomain subdomain;
    subdomain.points = std::move(border.points);
    subdomain.global = std::move(border.global);
    subdomain.segments = std::move(border.segments);
    subdomain.size = size.restricted_to(box);
    subdomain.refine = refine;
    subdomain.refine.lattice = refine.lattice && estimated.estimate.lattice;
    subdomain.refine.expected_triangles = static_cast<std::size_t>(estimated.estimate.triangles);
    subdomain.estimated_triangles = estimated.estimate.triangles;
    return subdomain;
}

/// Returns the corners of the far field, or of a polygon of many sides in a circle; counter-clockwise.
std::vector<Point> outline_of(const FarField& far_field) {
    if (far_field.shape == FarFieldShape::outline) return far_field.outline;
    if (far_field.shape == FarFieldShape::box) {
        const auto corners = far_field.box().corners();
        return {corners.begin(), corners.end()};
    }
    constexpr std::size_t sides = 64;
    return divide_circle(far_field.center, far_field.radius, SizeField(far_field.radius), sides);
}

}  // namespace

}  // namespace lamina::decoupling

namespace lamina {

using namespace decoupling;

double estimate_triangles(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                          const SizeField& size, const FarField& far_field) {
    near_body_box(box_round(points, borders), inscribed_box(far_field), far_field);  // throws where there is no room
    Skeleton skeleton = start_skeleton(points, borders);
    std::vector<VertexId> outline;
    for (const Point corner : outline_of(far_field)) outline.push_back(skeleton.add_point(corner));
    for (std::size_t i = 0; i < outline.size(); ++i)
        skeleton.edges.push_back({outline[i], outline[(i + 1) % outline.size()]});
    double triangles = 0;
    for (const SubdomainBorder& border : trace_borders(skeleton.points, skeleton.edges))
        triangles += estimate_undivided(skeleton.points, border, size);
    return triangles;
}

Decoupling decouple(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                    const SizeField& size, const FarField& far_field, const DecouplingOptions& options,
                    const RefineOptions& refine) {
    validate(options);
    validate(refine);
    const bool is_box = far_field.shape == FarFieldShape::box;
    const Box outermost = inscribed_box(far_field);
    const auto near_body = near_body_box(box_round(points, borders), outermost, far_field);

    Skeleton skeleton = start_skeleton(points, borders);
    const SeparatorSpacing spacing{size, options.separators};
    std::vector<Segment> far_field_edges;
    if (near_body || is_box) {
        const RingBoxes boxes{near_body.value_or(outermost), outermost};
        const std::vector<Ring> rings = plan_rings(boxes, size, options.pieces_target);
        far_field_edges = add_rings(skeleton, rings, boxes, spacing, !is_box);
    }
    if (!is_box) far_field_edges = add_far_field_outline(skeleton, far_field, spacing);

    const std::vector<EstimatedBorder> estimated =
        cut_to_size(skeleton, trace_borders(skeleton.points, skeleton.edges), spacing, options.pieces_target);
    Decoupling result;
    result.subdomains.resize(estimated.size());
    core::parallel_for(estimated.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            result.subdomains[i] = make_subdomain(skeleton, estimated[i], size, refine);
    });
    result.separator_vertices = skeleton.points.size() - points.size();
    result.points = std::move(skeleton.points);
    result.far_field = std::move(far_field_edges);
    return result;
}

}  // namespace lamina
