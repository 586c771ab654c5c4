// Rings of geometrically similar trapezoids from the near-body box to the far field.
// Source: J. K. Pardue, thesis (2015), chapter 5.
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "kernel/estimate.hpp"
#include "outer/separators.hpp"
#include "outer/skeleton.hpp"

namespace lamina::outer {

namespace {

Box box_at(const Box& near_body, const Box& outermost, double t) {
    return {near_body.lower + t * (outermost.lower - near_body.lower),
            near_body.upper + t * (outermost.upper - near_body.upper)};
}

/// Extents of a quarter of a ring, in edge lengths.
struct Extents {
    double radial = 0;      ///< outwards
    double tangential = 0;  ///< along the side
};

/// What a quarter of the ring between two parameters holds, on the average over the four sides; and its extents if h
/// were everywhere as it is where the ring is coarsest.
struct QuarterRing {
    double triangles = 0;
    Extents mean, least;
};

/// Integrates from `inner` to `outer` in steps that grow with the box, sampling each side at its quarters.
QuarterRing measure(const Box& near_body, const Box& outermost, const SizeField& size, double inner, double outer) {
    QuarterRing quarter;
    const double extent = std::max(near_body.width(), near_body.height());
    const double growth = std::max(outermost.width(), outermost.height()) - extent;
    constexpr int samples = 4;
    std::array<Extents, 4 * samples> extents;  // by side and place on it
    double t = inner;
    while (t < outer) {
        const double step = std::min(0.1 * (extent / growth + t), outer - t);
        const double next = t + step < outer * (1 - 1e-12) ? t + step : outer;
        const auto from = box_at(near_body, outermost, t).corners();
        const auto to = box_at(near_body, outermost, next).corners();
        const auto middle = box_at(near_body, outermost, 0.5 * (t + next)).corners();
        for (int side = 0; side < 4; ++side) {
            const int end = (side + 1) % 4;
            const Point a = middle[side], b = middle[end];
            const double area = 0.5 * (cross(from[side] - to[end], from[end] - to[side]));
            const double width = distance(midpoint(from[side], from[end]), midpoint(to[side], to[end]));
            for (int i = 0; i < samples; ++i) {
                const double along = (i + 0.5) / samples;
                const double h = size(a + along * (b - a));
                const double nearer = size(from[side] + along * (from[end] - from[side]));
                const double farther = size(to[side] + along * (to[end] - to[side]));
                const double gradient = std::abs(farther - nearer) / width;
                quarter.triangles += kernel::estimated_triangles(std::abs(area), 1 / (h * h), gradient) / (4 * samples);
                Extents& extent_there = extents[static_cast<std::size_t>(side * samples + i)];
                extent_there.radial += width / h;
                extent_there.tangential += distance(a, b) * (next - t) / ((outer - inner) * h);
            }
        }
        t = next;
    }
    quarter.least = extents.front();
    for (const Extents& e : extents) {
        quarter.mean.radial += e.radial / extents.size();
        quarter.mean.tangential += e.tangential / extents.size();
        quarter.least = {std::min(quarter.least.radial, e.radial), std::min(quarter.least.tangential, e.tangential)};
    }
    return quarter;
}

void plan(const Box& near_body, const Box& outermost, const SizeField& size, double pieces_target, double inner,
          double outer, std::size_t per_side, std::vector<Ring>& rings) {
    const QuarterRing quarter = measure(near_body, outermost, size, inner, outer);
    const auto n = static_cast<double>(per_side);
    constexpr double fewest_segments = 8;  // no side of a piece gets shorter than this when it is halved
    const bool wide = quarter.mean.tangential / n > quarter.mean.radial;
    const double longer = wide ? quarter.least.tangential / n : quarter.least.radial;
    if (quarter.triangles <= pieces_target * n || longer < 2 * fewest_segments) {
        rings.push_back({inner, outer, per_side});
    } else if (wide) {
        plan(near_body, outermost, size, pieces_target, inner, outer, 2 * per_side, rings);
    } else {
        // The box grows linearly with t: halve the logarithm of its extent, along which edge lengths are even.
        const double extent = std::max(near_body.width(), near_body.height());
        const double s = extent / (std::max(outermost.width(), outermost.height()) - extent);
        const double cut = std::sqrt((s + inner) * (s + outer)) - s;
        plan(near_body, outermost, size, pieces_target, inner, cut, per_side, rings);
        plan(near_body, outermost, size, pieces_target, cut, outer, per_side, rings);
    }
}

/// A straight line between two vertices of the skeleton, still to be divided.
struct RingLine {
    VertexId from, to;
    bool outermost = false;
};

/// The lines round the boxes, from the near-body box outwards, and the separators of the rings. Where they meet the
/// skeleton gets vertices.
std::vector<RingLine> add_junctions(Skeleton& skeleton, std::span<const Ring> rings, const Box& near_body,
                                    const Box& outermost) {
    std::vector<RingLine> lines;
    // junctions[level][side * per_side + j]: where separators meet the box between two rings.
    std::vector<std::vector<VertexId>> junctions(rings.size() + 1);
    std::vector<std::size_t> per_side(rings.size() + 1);
    for (std::size_t level = 0; level <= rings.size(); ++level) {
        const std::size_t below = level > 0 ? rings[level - 1].per_side : 1;
        const std::size_t above = level < rings.size() ? rings[level].per_side : 1;
        const std::size_t n = per_side[level] = std::max(below, above);
        const auto corner =
            (level < rings.size() ? box_at(near_body, outermost, rings[level].inner) : outermost).corners();
        for (std::size_t side = 0; side < 4; ++side)
            for (std::size_t j = 0; j < n; ++j)
                junctions[level].push_back(
                    skeleton.add_point(corner[side] + (static_cast<double>(j) / static_cast<double>(n)) *
                                                          (corner[(side + 1) % 4] - corner[side])));
        for (std::size_t j = 0; j < 4 * n; ++j)
            lines.push_back({junctions[level][j], junctions[level][(j + 1) % (4 * n)], level == rings.size()});
    }
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
        const std::size_t n = rings[ring].per_side;
        for (std::size_t j = 0; j < 4 * n; ++j)
            lines.push_back(
                {junctions[ring][j * (per_side[ring] / n)], junctions[ring + 1][j * (per_side[ring + 1] / n)]});
    }
    return lines;
}

}  // namespace

void Skeleton::add_chain(std::span<const VertexId> chain, bool both_directions) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        edges.push_back({chain[i], chain[i + 1]});
        if (both_directions) edges.push_back({chain[i + 1], chain[i]});
    }
}

std::vector<Ring> plan_rings(const Box& near_body, const Box& outermost, const SizeField& size, double pieces_target) {
    std::vector<Ring> rings;
    if (near_body.width() < outermost.width()) plan(near_body, outermost, size, pieces_target, 0, 1, 1, rings);
    return rings;
}

std::vector<Segment> add_rings(Skeleton& skeleton, std::span<const Ring> rings, const Box& near_body,
                               const Box& outermost, const SizeField& size, SeparatorRule rule, bool something_beyond) {
    const std::vector<RingLine> lines = add_junctions(skeleton, rings, near_body, outermost);
    const auto interiors = parallel_blocks(lines.size(), 1, [&](std::size_t i, std::size_t) {
        constexpr std::size_t fewest = 3;
        return separate(skeleton.points[lines[i].from.index()], skeleton.points[lines[i].to.index()], size, rule,
                        fewest);
    });
    std::vector<Segment> outermost_edges;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::vector<VertexId> chain{lines[i].from};
        for (Point p : interiors[i]) chain.push_back(skeleton.add_point(p));
        chain.push_back(lines[i].to);
        skeleton.add_chain(chain, !lines[i].outermost || something_beyond);
        if (!lines[i].outermost) continue;
        for (std::size_t k = 0; k + 1 < chain.size(); ++k) outermost_edges.push_back({chain[k], chain[k + 1]});
    }
    return outermost_edges;
}

std::vector<Segment> add_outline(Skeleton& skeleton, const DecouplingOptions& options, const SizeField& size) {
    constexpr std::size_t fewest = 3, fewest_round_a_circle = 16;
    std::vector<VertexId> loop;
    if (options.far_field_shape == FarFieldShape::circle) {
        for (Point p : divide_circle(options.center, options.far_field * options.chord, size, fewest_round_a_circle))
            loop.push_back(skeleton.add_point(p));
    } else {
        for (std::size_t i = 0; i < options.outline.size(); ++i) {
            const Point u = options.outline[i], v = options.outline[(i + 1) % options.outline.size()];
            loop.push_back(skeleton.add_point(u));
            for (Point p : separate(u, v, size, options.rule, fewest)) loop.push_back(skeleton.add_point(p));
        }
    }
    loop.push_back(loop.front());
    skeleton.add_chain(loop, false);
    std::vector<Segment> edges;
    for (std::size_t i = 0; i + 1 < loop.size(); ++i) edges.push_back({loop[i], loop[i + 1]});
    return edges;
}

}  // namespace lamina::outer
