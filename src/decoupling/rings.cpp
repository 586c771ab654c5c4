// Rings consist of geometrically similar trapezoids. Source: J. K. Pardue, thesis (2015), chapter 5.
//
//      o-----------------o
//      | \             / |      A ring with one trapezoid per side. Each line is one chain of vertices, and chains meet
//      |   o---------o   |      at junctions (o) only.
//      |   | inner   |   |
//      |   | box     |   |
//      |   o---------o   |
//      | /             \ |
//      o-----------------o
#include "decoupling/rings.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/bounding_box.hpp"
#include "delaunay/refine/estimate.hpp"

namespace lamina::decoupling {

namespace {

constexpr std::size_t sides = 4;

/// Number of places on each side at which the size field is sampled.
constexpr std::size_t samples_per_side = 4;

/// Extents of a quarter of a ring, in edge lengths.
struct Extents {
    double radial = 0;      ///< from the inner box to the outer one
    double tangential = 0;  ///< along the side, half-way between the boxes
};

/// A quarter of a ring, one of its four sides.
struct QuarterRing {
    double triangles = 0;  ///< estimated, on average over the four quarters
    Extents mean;          ///< on average over all samples
    Extents min;           ///< if h were everywhere as it is where the ring is coarsest
};

/// Integrates over a ring in steps from the inner box to the outer one.
class RingIntegral {
public:
    RingIntegral(const RingBoxes& boxes, const SizeField& size, double inner, double outer)
        : boxes_(boxes), size_(size), inner_(inner), outer_(outer) {}

    /// Adds the part of the ring between two parameters.
    void add_step(double t, double next) {
        const auto from = boxes_.at(t).corners(), to = boxes_.at(next).corners();
        if (!sizes_inside_known_) sample(from, sizes_inside_);
        sample(to, sizes_outside_);
        const auto middle = boxes_.at(0.5 * (t + next)).corners();
        for (std::size_t side = 0; side < sides; ++side) {
            const std::size_t end = (side + 1) % sides;
            const Point a = middle[side], b = middle[end];
            const double area = 0.5 * (cross(from[side] - to[end], from[end] - to[side]));
            const double width = distance(midpoint(from[side], from[end]), midpoint(to[side], to[end]));
            for (std::size_t i = 0; i < samples_per_side; ++i) {
                const double along = (static_cast<double>(i) + 0.5) / samples_per_side;
                const double h = size_(a + along * (b - a));
                const std::size_t at = side * samples_per_side + i;
                const double gradient = std::abs(sizes_outside_[at] - sizes_inside_[at]) / width;
                triangles_ += delaunay::estimated_triangles(std::abs(area), 1 / (h * h), gradient) /
                              static_cast<double>(extents_.size());
                Extents& extents = extents_[at];
                extents.radial += width / h;
                extents.tangential += distance(a, b) * (next - t) / ((outer_ - inner_) * h);
            }
        }
        // The next step begins where this one ends.
        sizes_inside_ = sizes_outside_;
        sizes_inside_known_ = true;
    }

    QuarterRing result() const {
        QuarterRing quarter{triangles_, {}, extents_.front()};
        const auto n = static_cast<double>(extents_.size());
        for (const Extents& e : extents_) {
            quarter.mean.radial += e.radial / n;
            quarter.mean.tangential += e.tangential / n;
            quarter.min = {std::min(quarter.min.radial, e.radial), std::min(quarter.min.tangential, e.tangential)};
        }
        return quarter;
    }

private:
    const RingBoxes& boxes_;
    const SizeField& size_;
    double inner_, outer_;
    double triangles_ = 0;
    std::array<Extents, sides * samples_per_side> extents_;  ///< by side and sample
    std::array<double, sides * samples_per_side> sizes_inside_{}, sizes_outside_{};
    bool sizes_inside_known_ = false;

    /// Takes the sizes at the samples along a box.
    void sample(const std::array<Point, sides>& corners, std::array<double, sides * samples_per_side>& sizes) const {
        for (std::size_t side = 0; side < sides; ++side)
            for (std::size_t i = 0; i < samples_per_side; ++i) {
                const double along = (static_cast<double>(i) + 0.5) / samples_per_side;
                sizes[side * samples_per_side + i] =
                    size_(corners[side] + along * (corners[(side + 1) % sides] - corners[side]));
            }
    }
};

/// Measures a ring between two parameters in steps that grow with the box.
QuarterRing measure_ring(const RingBoxes& boxes, const SizeField& size, double inner, double outer) {
    const double near_extent = core::longer_side(boxes.near_body);
    const double growth = core::longer_side(boxes.outermost) - near_extent;
    RingIntegral integral(boxes, size, inner, outer);
    for (double t = inner; t < outer;) {
        const double step = std::min(0.1 * (near_extent / growth + t), outer - t);
        // Rounding might otherwise keep the last step from reaching the end.
        const double next = t + step < outer * (1 - 1e-12) ? t + step : outer;
        integral.add_step(t, next);
        t = next;
    }
    return integral.result();
}

/// Divides rings until their trapezoids are small enough.
class RingPlanner {
public:
    RingPlanner(const RingBoxes& boxes, const SizeField& size, double pieces_target)
        : boxes_(boxes), size_(size), pieces_target_(pieces_target) {}

    void plan(const Ring& ring) { plan(ring, measure_ring(boxes_, size_, ring.inner, ring.outer)); }

    std::vector<Ring> rings;

private:
    void plan(const Ring& ring, const QuarterRing& quarter) {
        const auto [inner, outer, per_side] = ring;
        const auto n = static_cast<double>(per_side);
        constexpr double min_segments = 8;  // of every side of a trapezoid that was halved
        const bool is_wide = quarter.mean.tangential / n > quarter.mean.radial;
        const double min_extent = is_wide ? quarter.min.tangential / n : quarter.min.radial;
        if (quarter.triangles <= pieces_target_ * n || min_extent < 2 * min_segments) {
            rings.push_back(ring);
        } else if (is_wide) {
            plan({inner, outer, 2 * per_side}, quarter);
        } else {
            const double middle = middle_of(inner, outer);
            plan({inner, middle, per_side});
            plan({middle, outer, per_side});
        }
    }

    /// Returns the parameter at which the logarithm of the box's extent is half-way between inner and outer. The box
    /// grows linearly with the parameter, and edges grow about as the box does.
    double middle_of(double inner, double outer) const {
        const double near_extent = core::longer_side(boxes_.near_body);
        const double offset = near_extent / (core::longer_side(boxes_.outermost) - near_extent);
        return std::sqrt((offset + inner) * (offset + outer)) - offset;
    }

    const RingBoxes& boxes_;
    const SizeField& size_;
    double pieces_target_;
};

/// The junctions on the boxes between rings, inside and outside all of them: level by level from inside, and
/// counter-clockwise on each.
struct RingJunctions {
    std::vector<std::size_t> per_side;  ///< per level
    std::vector<std::uint32_t> first;   ///< per level: how many are on those before
    std::uint32_t first_id = 0;

    /// Returns the first one of a level.
    VertexId at(std::size_t level) const { return VertexId{std::size_t{first_id} + first[level]}; }
};

/// Adds the junctions to the skeleton.
RingJunctions add_junctions(Skeleton& skeleton, std::span<const Ring> rings, const RingBoxes& boxes) {
    RingJunctions junctions;
    junctions.first_id = static_cast<std::uint32_t>(skeleton.lines.junctions());
    std::uint32_t added = 0;
    std::size_t expected = 0;
    for (const Ring& ring : rings) expected += 2 * sides * ring.per_side;
    skeleton.lines.expect_junctions(expected + sides);
    for (std::size_t level = 0; level <= rings.size(); ++level) {
        const std::size_t of_inner_ring = level > 0 ? rings[level - 1].per_side : 1;
        const std::size_t of_outer_ring = level < rings.size() ? rings[level].per_side : 1;
        const std::size_t n = std::max(of_inner_ring, of_outer_ring);
        junctions.per_side.push_back(n);
        junctions.first.push_back(added);
        const auto corners = (level < rings.size() ? boxes.at(rings[level].inner) : boxes.outermost).corners();
        for (std::size_t side = 0; side < sides; ++side)
            for (std::size_t j = 0; j < n; ++j)
                skeleton.add_junction(corners[side] + (static_cast<double>(j) / static_cast<double>(n)) *
                                                          (corners[(side + 1) % sides] - corners[side]));
        added += static_cast<std::uint32_t>(sides * n);
    }
    return junctions;
}

}  // namespace

std::vector<Ring> plan_rings(const RingBoxes& boxes, const SizeField& size, double pieces_target) {
    RingPlanner planner(boxes, size, pieces_target);
    if (boxes.near_body.width() < boxes.outermost.width()) planner.plan({0, 1, 1});
    return std::move(planner.rings);
}

std::vector<std::uint32_t> add_rings(Skeleton& skeleton, std::span<const Ring> rings, const RingBoxes& boxes,
                                     bool region_beyond) {
    constexpr std::uint32_t min_segments = 3;
    const auto first_line = static_cast<std::uint32_t>(skeleton.lines.size());
    const RingJunctions junctions = add_junctions(skeleton, rings, boxes);
    std::vector<std::uint32_t> outermost;
    // Trapezoids are not traced: the regions round the bodies and beyond the rings are.
    for (std::size_t level = 0; level <= rings.size(); ++level) {
        const bool is_outermost = level == rings.size();
        const auto n = static_cast<std::uint32_t>(sides * junctions.per_side[level]);
        const std::uint32_t first = junctions.at(level).value;
        const std::uint32_t added =
            skeleton.add_row({n, first, 1, first, 1, 1, min_segments}, {level == 0, is_outermost && region_beyond});
        for (std::uint32_t j = 0; is_outermost && j < n; ++j) outermost.push_back(added + j);
    }
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
        const std::size_t n = rings[ring].per_side;
        assert(junctions.per_side[ring] % n == 0 && junctions.per_side[ring + 1] % n == 0);
        const auto inner = static_cast<std::uint32_t>(junctions.per_side[ring] / n);
        const auto outer = static_cast<std::uint32_t>(junctions.per_side[ring + 1] / n);
        const auto trapezoids = static_cast<std::uint32_t>(sides * n);
        const std::uint32_t radial = skeleton.add_row(
            {trapezoids, junctions.at(ring).value, inner, junctions.at(ring + 1).value, outer, 0, min_segments}, {});
        skeleton.rings.add({first_line + junctions.first[ring], inner, first_line + junctions.first[ring + 1], outer,
                            radial, trapezoids});
    }
    return outermost;
}

}  // namespace lamina::decoupling
