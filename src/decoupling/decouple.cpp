// The outer region cut into pieces: near-body box, rings of trapezoids, then cuts of whatever is still too large; every
// piece becomes a self-contained Subdomain.
// Source: J. K. Pardue, thesis (2015), chapter 5.
#include <algorithm>
#include <numeric>
#include <optional>

#include <lamina/decoupling.hpp>

#include "core/parallel.hpp"
#include "decoupling/cut.hpp"
#include "decoupling/far_field.hpp"
#include "decoupling/piece.hpp"
#include "decoupling/refine_all.hpp"
#include "decoupling/skeleton.hpp"

namespace lamina::decoupling {
namespace {

Box box_around(std::span<const Point> points, std::span<const std::vector<VertexId>> borders) {
    Box box;
    for (const auto& border : borders)
        for (VertexId v : border) box.include(points[v.index()]);
    return box;
}

Subdomain make_subdomain(const Skeleton& skeleton, const SizedPiece& sized, const SizeField& size,
                         const RefineOptions& refine) {
    Subdomain s;
    s.refine = refine;
    s.refine.lattice = refine.lattice && sized.lattice;
    s.refine.expected_triangles = static_cast<std::size_t>(sized.triangles);
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

std::vector<Refinement> refine_all(std::span<const Subdomain> subdomains, core::BusyTimes* times, std::size_t kind) {
    std::vector<std::size_t> order(subdomains.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return subdomains[a].estimated_triangles > subdomains[b].estimated_triangles;
    });
    std::vector<Refinement> refinements(subdomains.size());
    core::parallel_for(order.size(), 1, [&](std::size_t begin, std::size_t end) {
        const core::BusyTimes::Scope busy(times, kind);
        for (std::size_t i = begin; i < end; ++i) refinements[order[i]] = refine(subdomains[order[i]]);
    });
    return refinements;
}

}  // namespace lamina::decoupling

namespace lamina {

using namespace decoupling;

Decoupling decouple(std::span<const Point> points, std::span<const std::vector<VertexId>> borders,
                    const SizeField& size, const FarField& far_field, const DecouplingOptions& options,
                    const RefineOptions& refine) {
    validate(options);
    validate(refine);
    const bool is_box = far_field.shape == FarFieldShape::box;
    const Box outermost = inscribed_box(far_field);
    const auto near_body = near_body_box(box_around(points, borders), outermost, far_field);

    Skeleton skeleton;
    skeleton.points.assign(points.begin(), points.end());
    for (const auto& border : borders)
        for (std::size_t i = 0; i < border.size(); ++i)
            skeleton.edges.push_back({border[i + 1 < border.size() ? i + 1 : 0], border[i]});
    const Separation separation{size, options.separators};
    std::vector<Segment> far_field_edges;
    if (near_body || is_box) {
        const RingBoxes boxes{near_body.value_or(outermost), outermost};
        const auto rings = plan_rings(boxes, size, options.pieces_target);
        far_field_edges = add_rings(skeleton, rings, boxes, separation, !is_box);
    }
    if (!is_box) far_field_edges = add_outline(skeleton, far_field, separation);

    const auto pieces =
        cut_to_size(skeleton, trace_pieces(skeleton.points, skeleton.edges), separation, options.pieces_target);
    Decoupling result;
    result.subdomains.resize(pieces.size());
    core::parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            result.subdomains[i] = make_subdomain(skeleton, pieces[i], size, refine);
    });
    result.separator_vertices = skeleton.points.size() - points.size();
    result.points = std::move(skeleton.points);
    result.far_field = std::move(far_field_edges);
    return result;
}

Refinement refine(const Subdomain& subdomain) {
    return refine(subdomain.points, subdomain.segments, subdomain.size, subdomain.refine);
}

std::vector<Refinement> refine(std::span<const Subdomain> subdomains) { return refine_all(subdomains, nullptr, 0); }

}  // namespace lamina
