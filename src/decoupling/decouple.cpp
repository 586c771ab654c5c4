// The outer region becomes subdomains: near-body box and rings of trapezoids first, then cuts of all subdomains that
// are still too large. Source: J. K. Pardue, thesis (2015), chapter 5.
#include "decoupling/subdomain.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "decoupling/border_triangulation.hpp"
#include "decoupling/cut_region.hpp"
#include "decoupling/cut_to_size.hpp"
#include "decoupling/far_field.hpp"
#include "decoupling/rings.hpp"
#include "decoupling/separators.hpp"
#include "decoupling/shared_search.hpp"
#include "decoupling/skeleton.hpp"

namespace lamina::decoupling {

namespace {

/// Returns the box round all borders.
Box box_round(std::span<const Point> points, std::span<const std::vector<VertexId>> borders) {
    Box box;
    for (const std::vector<VertexId>& border : borders)
        for (const VertexId v : border) box.include(points[v.index()]);
    return box;
}

/// Returns the box round the borders of bodies, and round lines inside the region.
Box box_round_bodies(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                     const FarField& far_field, const InnerLines& inner = {}) {
    Box box = box_round(points, borders.first(borders.size() - far_field.has_walls()));
    for (const Point p : inner.points) box.include(p);
    return box;
}

/// Adds lines inside the region. Returns the number of the first one.
std::uint32_t add_inner_lines(const InnerLines& inner, Skeleton& skeleton) {
    for (const Point p : inner.points) skeleton.add_junction(p);
    const auto first = static_cast<std::uint32_t>(skeleton.lines.size());
    for (const Segment& line : inner.lines) skeleton.add_line(line.a, line.b, 1, {.left = true, .right = true});
    return first;
}

/// Starts a skeleton with the borders of the layers, turned clockwise: the outer region lies on their left.
Skeleton start_skeleton(std::span<const Point> points, std::span<const std::vector<VertexId>> borders) {
    Skeleton skeleton(points);
    for (const std::vector<VertexId>& border : borders) {
        std::vector<VertexId> turned(border.rbegin(), border.rend());
        // It begins with the edge between the first two vertices.
        std::rotate(turned.begin(), turned.end() - 2, turned.end());
        skeleton.add_loop(turned);
    }
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
    std::vector<std::uint32_t> far_field_lines{};
    std::uint32_t first_inner_line = 0;
};

/// Divides all lines and numbers their vertices.
void number_lines(Lines& lines, const SizeField& size) {
    core::parallel_for(lines.size(), 1, [&](std::size_t i, std::size_t) {
        if (const auto line = static_cast<std::uint32_t>(i); !lines.is_loop(line)) lines.divide(line, size);
    });
    for (std::uint32_t line = 0; line < lines.size(); ++line)
        if (!lines.is_loop(line)) lines.number(line, lines.divide(line, size));
}

UncutSkeleton draw_skeleton(const OuterRegion& region, const SizeField& size, core::ConnectedRanks* ranks) {
    const FarField& far_field = region.far_field;
    const bool is_box = far_field.shape == FarFieldShape::box;
    const Box outermost = inscribed_box(far_field);
    const auto near_body =
        near_body_box(box_round_bodies(region.points, region.borders, far_field, region.inner), outermost, far_field);
    UncutSkeleton uncut{start_skeleton(region.points, region.borders), {}};
    Lines& lines = uncut.skeleton.lines;
    uncut.first_inner_line = add_inner_lines(region.inner, uncut.skeleton);
    std::vector<std::uint32_t> outermost_lines;
    if (near_body || is_box) {
        const RingBoxes boxes{near_body.value_or(outermost), outermost};
        const std::vector<Ring> rings = plan_rings(boxes, region.size, region.options.pieces_target);
        outermost_lines = add_rings(uncut.skeleton, rings, boxes, !is_box);
    }
    if (ranks != nullptr) {
        uncut.skeleton.number_together(size, *ranks);
    } else {
        number_lines(lines, size);
    }
    if (far_field.has_walls()) return uncut;
    if (!is_box) {
        uncut.far_field = add_far_field_outline(uncut.skeleton, far_field, size);
        uncut.far_field_lines.push_back(static_cast<std::uint32_t>(lines.size() - 1));
        return uncut;
    }
    for (const std::uint32_t line : outermost_lines) {
        const std::vector<Segment> edges = edges_along(lines, line);
        uncut.far_field.insert(uncut.far_field.end(), edges.begin(), edges.end());
    }
    uncut.far_field_lines = std::move(outermost_lines);
    return uncut;
}

}  // namespace

CutRegion cut_region(const OuterRegion& region, core::ConnectedRanks* ranks, const BesideCuts& beside) {
    if (ranks != nullptr && ranks->size() == 1) ranks = nullptr;
    const SizeField& size = region.size;
    auto [skeleton, far_field_edges, far_field_lines, first_inner_line] = draw_skeleton(region, size, ranks);
    if (beside.once_numbered) beside.once_numbered();
    UncutRegions uncut{skeleton.trace(), skeleton.rings};
    if (!region.inner.lines.empty())
        for (LineBorder& border : uncut.borders) border.may_dangle = true;
    std::vector<std::vector<Segment>> inner_edges;
    for (std::size_t i = 0; i < region.inner.lines.size(); ++i)
        inner_edges.push_back(edges_along(skeleton.lines, first_inner_line + static_cast<std::uint32_t>(i)));
    CutRegion cut{std::move(skeleton.lines),
                  std::move(skeleton.rings),
                  std::move(far_field_edges),
                  std::move(far_field_lines),
                  {},
                  0,
                  std::move(inner_edges)};
    const double target = region.options.pieces_target;
    if (ranks != nullptr) {
        if (beside.make) cut.lines.gather_points();
        cut.borders = cut_to_size_together(cut.lines, std::move(uncut), size, target, *ranks, beside.make);
    } else {
        cut.borders = cut_to_size(cut.lines, std::move(uncut), size, target);
    }
    cut.separator_vertices = cut.lines.vertices() - region.points.size();
    return cut;
}

LineBorder CutRegion::border(std::size_t subdomain) const {
    const EstimatedBorder& border = borders[subdomain];
    return border.border ? *border.border : rings.border(border.trapezoid, lines);
}

Subdomain make_subdomain(const LineBorder& line_border, const WorkEstimate* known, Lines& lines, const SizeField& size,
                         const RefineOptions& refine) {
    LocalBorder border = localize(line_border, lines, size);
    const WorkEstimate estimate = known != nullptr ? *known : BorderTriangulation(border, size).estimate();
    Box box;
    for (const Point p : border.points) box.include(p);
    Subdomain subdomain;
    subdomain.points = std::move(border.points);
    subdomain.global = std::move(border.global);
    subdomain.segments = std::move(border.segments);
    subdomain.size = size.restricted_to(box);
    subdomain.refine = refine;
    subdomain.refine.lattice = refine.lattice && estimate.lattice;
    subdomain.refine.expected_triangles = static_cast<std::size_t>(estimate.triangles);
    subdomain.estimated_triangles = estimate.triangles;
    return subdomain;
}

double estimate_triangles(const OuterRegion& region) {
    const FarField& far_field = region.far_field;
    // Throws where there is no room.
    near_body_box(box_round_bodies(region.points, region.borders, far_field), inscribed_box(far_field), far_field);
    Skeleton skeleton = start_skeleton(region.points, region.borders);
    if (!far_field.has_walls()) skeleton.add_new_loop(outline_of(far_field));
    double triangles = 0;
    for (const LineBorder& border : skeleton.trace())
        triangles += estimate_undivided(localize(border, skeleton.lines, region.size), region.size);
    return triangles;
}

Decoupling decouple(const OuterRegion& region, const RefineOptions& refine) {
    validate(region.options);
    validate(refine);
    CutRegion cut = cut_region(region);
    Decoupling result;
    result.subdomains.resize(cut.borders.size());
    core::parallel_for(cut.borders.size(), 1, [&](std::size_t i, std::size_t) {
        result.subdomains[i] =
            make_subdomain(cut.border(i), cut.borders[i].estimate.get(), cut.lines, region.size, refine);
    });
    result.separator_vertices = cut.separator_vertices;
    result.points.resize(cut.lines.vertices());
    cut.lines.copy_points(result.points);
    result.far_field = std::move(cut.far_field);
    result.inner_edges = std::move(cut.inner_edges);
    return result;
}

}  // namespace lamina::decoupling
