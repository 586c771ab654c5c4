// The outer region becomes subdomains: near-body box and rings of trapezoids first, then cuts of all subdomains that
// are still too large. Source: J. K. Pardue, thesis (2015), chapter 5.
#include <lamina/decoupling.hpp>

#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "decoupling/border_triangulation.hpp"
#include "decoupling/cut_region.hpp"
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

/// A skeleton of which nothing is cut to size yet.
struct UncutSkeleton {
    Skeleton skeleton;
    std::vector<Segment> far_field;  ///< edges of the far field; the region lies on their left
};

UncutSkeleton draw_skeleton(const OuterRegion& region, const SeparatorSpacing& spacing) {
    const FarField& far_field = region.far_field;
    const bool is_box = far_field.shape == FarFieldShape::box;
    const Box outermost = inscribed_box(far_field);
    const auto near_body = near_body_box(box_round(region.points, region.borders), outermost, far_field);
    UncutSkeleton uncut{start_skeleton(region.points, region.borders), {}};
    if (near_body || is_box) {
        const RingBoxes boxes{near_body.value_or(outermost), outermost};
        const std::vector<Ring> rings = plan_rings(boxes, region.size, region.options.pieces_target);
        uncut.far_field = add_rings(uncut.skeleton, rings, boxes, spacing, !is_box);
    }
    if (!is_box) uncut.far_field = add_far_field_outline(uncut.skeleton, far_field, spacing);
    return uncut;
}

}  // namespace

CutRegion cut_region(const OuterRegion& region, Ranks* ranks) {
    const SeparatorSpacing spacing{region.size, region.options.separators};
    auto [skeleton, far_field_edges] = draw_skeleton(region, spacing);
    std::vector<SubdomainBorder> borders = trace_borders(skeleton.points, skeleton.edges);
    const double target = region.options.pieces_target;
    CutRegion cut;
    if (ranks != nullptr && ranks->size() > 1) {
        require_same_skeleton(skeleton, *ranks);
        cut.borders = cut_to_size_together(skeleton, std::move(borders), spacing, target, *ranks);
    } else {
        cut.borders = cut_to_size(skeleton, std::move(borders), spacing, target);
    }
    cut.separator_vertices = skeleton.points.size() - region.points.size();
    cut.points = std::move(skeleton.points);
    cut.far_field = std::move(far_field_edges);
    return cut;
}

Subdomain make_subdomain(std::span<const Point> points, const EstimatedBorder& estimated, const SizeField& size,
                         const RefineOptions& refine) {
    LocalBorder border = localize(estimated.border, points);
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
    CutRegion cut = cut_region({points, borders, size, far_field, options});
    Decoupling result;
    result.subdomains.resize(cut.borders.size());
    core::parallel_for(cut.borders.size(), 1, [&](std::size_t i, std::size_t) {
        result.subdomains[i] = make_subdomain(cut.points, cut.borders[i], size, refine);
    });
    result.separator_vertices = cut.separator_vertices;
    result.points = std::move(cut.points);
    result.far_field = std::move(cut.far_field);
    return result;
}

}  // namespace lamina
