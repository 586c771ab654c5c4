// Rings of geometrically similar trapezoids from the near-body box to the far field.
// Source: J. K. Pardue, thesis (2015), chapter 5.
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "decoupling/separators.hpp"
#include "decoupling/skeleton.hpp"
#include "delaunay/estimate.hpp"

namespace lamina::decoupling {

namespace {

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
QuarterRing measure(const RingBoxes& boxes, const SizeField& size, double inner, double outer) {
    const auto& [near_body, outermost] = boxes;
    QuarterRing quarter;
    const double extent = std::max(near_body.width(), near_body.height());
    const double growth = std::max(outermost.width(), outermost.height()) - extent;
    constexpr int samples = 4;
    std::array<Extents, 4 * samples> extents;  // by side and place on it
    double t = inner;
    while (t < outer) {
        const double step = std::min(0.1 * (extent / growth + t), outer - t);
        const double next = t + step < outer * (1 - 1e-12) ? t + step : outer;
        const auto from = boxes.at(t).corners();
        const auto to = boxes.at(next).corners();
        const auto middle = boxes.at(0.5 * (t + next)).corners();
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
                quarter.triangles +=
                    delaunay::estimated_triangles(std::abs(area), 1 / (h * h), gradient) / (4 * samples);
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

/// Divides rings until their trapezoids are small enough.
class RingPlanner {
public:
    RingPlanner(const RingBoxes& boxes, const SizeField& size, double pieces_target)
        : boxes_(boxes), size_(size), pieces_target_(pieces_target) {}

    void plan(const Ring& ring) {
        const auto [inner, outer, per_side] = ring;
        const QuarterRing quarter = measure(boxes_, size_, inner, outer);
        const auto n = static_cast<double>(per_side);
        constexpr double fewest_segments = 8;  // no side of a piece gets shorter than this when it is halved
        const bool wide = quarter.mean.tangential / n > quarter.mean.radial;
        const double longer = wide ? quarter.least.tangential / n : quarter.least.radial;
        if (quarter.triangles <= pieces_target_ * n || longer < 2 * fewest_segments) {
            rings.push_back(ring);
        } else if (wide) {
            plan({inner, outer, 2 * per_side});
        } else {
            const double cut = middle(inner, outer);
            plan({inner, cut, per_side});
            plan({cut, outer, per_side});
        }
    }

    std::vector<Ring> rings;

private:
    const RingBoxes& boxes_;
    const SizeField& size_;
    double pieces_target_;

    /// The box grows linearly with the parameter: halves the logarithm of its extent, along which edge lengths are
    /// even.
    double middle(double inner, double outer) const {
        const auto extent = [](const Box& box) { return std::max(box.width(), box.height()); };
        const double near = extent(boxes_.near_body);
        const double s = near / (extent(boxes_.outermost) - near);
        return std::sqrt((s + inner) * (s + outer)) - s;
    }
};

/// A straight line between two vertices of the skeleton, still to be divided.
struct RingLine {
    VertexId from, to;
    bool outermost = false;
};

/// The lines round the boxes, from the near-body box outwards, and the separators of the rings. Where they meet the
/// skeleton gets vertices.
std::vector<RingLine> add_junctions(Skeleton& skeleton, std::span<const Ring> rings, const RingBoxes& boxes) {
    std::vector<RingLine> lines;
    // junctions[level][side * per_side + j]: where separators meet the box between two rings.
    std::vector<std::vector<VertexId>> junctions(rings.size() + 1);
    std::vector<std::size_t> per_side(rings.size() + 1);
    for (std::size_t level = 0; level <= rings.size(); ++level) {
        const std::size_t below = level > 0 ? rings[level - 1].per_side : 1;
        const std::size_t above = level < rings.size() ? rings[level].per_side : 1;
        const std::size_t n = per_side[level] = std::max(below, above);
        const auto corner = (level < rings.size() ? boxes.at(rings[level].inner) : boxes.outermost).corners();
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

std::vector<Ring> plan_rings(const RingBoxes& boxes, const SizeField& size, double pieces_target) {
    RingPlanner planner(boxes, size, pieces_target);
    if (boxes.near_body.width() < boxes.outermost.width()) planner.plan({0, 1, 1});
    return std::move(planner.rings);
}

std::vector<Segment> add_rings(Skeleton& skeleton, std::span<const Ring> rings, const RingBoxes& boxes,
                               const Separation& separation, bool something_beyond) {
    const std::vector<RingLine> lines = add_junctions(skeleton, rings, boxes);
    const auto interiors = core::parallel_blocks(lines.size(), 1, [&](std::size_t i, std::size_t) {
        constexpr std::size_t fewest = 3;
        return separate(skeleton.points[lines[i].from.index()], skeleton.points[lines[i].to.index()], separation,
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

std::vector<Segment> add_outline(Skeleton& skeleton, const FarField& far_field, const Separation& separation) {
    constexpr std::size_t fewest = 3, fewest_round_a_circle = 16;
    std::vector<VertexId> loop;
    if (far_field.shape == FarFieldShape::circle) {
        for (Point p : divide_circle(far_field.center, far_field.radius, separation.size, fewest_round_a_circle))
            loop.push_back(skeleton.add_point(p));
    } else {
        for (std::size_t i = 0; i < far_field.outline.size(); ++i) {
            const Point u = far_field.outline[i], v = far_field.outline[(i + 1) % far_field.outline.size()];
            loop.push_back(skeleton.add_point(u));
            for (Point p : separate(u, v, separation, fewest)) loop.push_back(skeleton.add_point(p));
        }
    }
    loop.push_back(loop.front());
    skeleton.add_chain(loop, false);
    std::vector<Segment> edges;
    for (std::size_t i = 0; i + 1 < loop.size(); ++i) edges.push_back({loop[i], loop[i + 1]});
    return edges;
}

}  // namespace lamina::decoupling
