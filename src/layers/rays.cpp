// Vertex normals, fans and refining rays. Source: J. K. Pardue, thesis (2015), chapter 3 and section 3.1.
#include "layers/rays.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "layers/heights.hpp"

namespace lamina::layers {
namespace {

/// Slack on the number of steps, so that an angle of exactly the limit is not divided.
constexpr double step_slack = 1e-9;
/// Rays may meet from so many times the height of the layers on: they end at 0.45 of the way to where they meet.
constexpr double clearance = 2.25;
/// Layers thicker than this share of the outline's length do not make its rays lean further.
constexpr double thickest_share = 0.05;
/// Degrees that a ray may lean to either side of the bisector, and be off the normals of both edges.
constexpr double largest_lean = 45, farthest_from_normal = 65;

std::size_t steps_for(double angle, double limit) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(std::abs(angle) / limit - step_slack)));
}

/// What surrounds one vertex of the body.
struct Corner {
    double turning;    ///< > 0 where the body is convex
    Point before;      ///< outward normal of the edge that arrives
    Point after;       ///< ... of the edge that leaves
    Point bisector;    ///< outward
    bool fan;          ///< several rays, from `before` to `after`; else one, the bisector
    double lean[2]{};  ///< radians that the first and the last ray lean, for the sake of concavities
};

/// The sum of the two normals vanishes as the edges fold onto each other; the difference of the tangents does not.
Point bisector(Point tangent_before, Point tangent_after, double turning) {
    if (std::abs(turning) < 0.5 * core::pi) return unit(-perpendicular(tangent_before) - perpendicular(tangent_after));
    return turning > 0 ? unit(tangent_before - tangent_after) : unit(tangent_after - tangent_before);
}

std::vector<Corner> make_corners(std::span<const Point> body, const LayerOptions& options) {
    const std::size_t n = body.size();
    std::vector<Corner> corners(n);
    Point before = unit(body[0] - body[n - 1]);
    for (std::size_t i = 0; i < n; ++i) {
        const Point after = unit(body[(i + 1) % n] - body[i]);
        const double turning = core::angle_between(before, after);
        const bool fan = options.corners == Corners::fan && turning > core::radians(sharp_corner_deg);
        corners[i] = {turning, -perpendicular(before), -perpendicular(after), bisector(before, after, turning), fan};
        before = after;
    }
    return corners;
}

/// Of one body, the height within which its rays should not meet.
double height_to_keep_clear(std::span<const Point> body, const LayerGrowth& growth) {
    double perimeter = 0;
    for (std::size_t i = 0; i < body.size(); ++i) perimeter += distance(body[i], body[(i + 1) % body.size()]);
    const double spacing = perimeter / static_cast<double>(body.size());
    return std::min(expected_height(growth, spacing), thickest_share * perimeter);
}

/// Rays that leave a concave corner or a noisy stretch by the bisectors meet at once. Here they may turn towards each
/// other by no more than 1 in (clearance x height of the layers) along the wall; what the wall turns more than that is
/// spread over the rays on both sides, which lean out of the corner.
///
/// Let a(s) be the rays' angle along the wall. The least function above a that falls nowhere faster than allowed turns
/// too late by `late`, the greatest one below it too early by `early`; their mean falls nowhere faster either, is a
/// itself where a is good, and treats both directions of the wall alike.
void lean_in_concavities(std::span<const Point> body, const LayerGrowth& growth, std::vector<Corner>& corners) {
    if (std::none_of(corners.begin(), corners.end(), [](const Corner& c) { return c.turning < 0; })) return;
    /// A ray, or the first or last one of a fan.
    struct End {
        double* lean;
        double most;               ///< it may lean
        double turning, distance;  ///< of the rays and along the wall to the next one
    };
    std::vector<End> ends;
    for (std::size_t i = 0; i < body.size(); ++i) {
        const std::size_t next = (i + 1) % body.size();
        Corner &corner = corners[i], &after = corners[next];
        const double room = core::radians(farthest_from_normal) - 0.5 * std::abs(corner.turning);
        const double most = std::clamp(corner.fan ? 0.25 * corner.turning : room, 0.0, core::radians(largest_lean));
        if (corner.fan) ends.push_back({&corner.lean[0], most, corner.turning, 0});
        const double turning = 0.5 * ((corner.fan ? 0 : corner.turning) + (after.fan ? 0 : after.turning));
        ends.push_back({&corner.lean[corner.fan], most, turning, distance(body[i], body[next])});
    }

    const std::size_t n = ends.size();
    const double steepest = 1 / (clearance * height_to_keep_clear(body, growth));
    const auto rise = [&](std::size_t i) { return ends[i].turning + steepest * ends[i].distance; };
    std::vector<double> late(n, 0.0), early(n, 0.0);
    // Twice round: what the first round brings to its start goes on in the second.
    for (std::size_t k = 0; k < 2 * n; ++k) {
        const std::size_t i = k % n, j = n - 1 - i;
        late[(i + 1) % n] = std::max(0.0, late[i] - rise(i));
        early[j] = std::max(0.0, early[(j + 1) % n] - rise(j));
    }
    for (std::size_t i = 0; i < n; ++i)
        *ends[i].lean = std::clamp(0.5 * (late[i] - early[i]), -ends[i].most, ends[i].most);
    for (Corner& corner : corners)
        if (!corner.fan) corner.lean[1] = corner.lean[0];
}

Point leaning(Point direction, double lean) { return lean == 0 ? direction : unit(core::rotated(direction, lean)); }

Point first_direction(const Corner& c) { return leaning(c.fan ? c.before : c.bisector, c.lean[0]); }
Point last_direction(const Corner& c) { return leaning(c.fan ? c.after : c.bisector, c.lean[1]); }

/// The fan is turned out of the bisector, not from one side to the other, so that mirrored input gives mirrored rays.
void add_vertex_rays(Point vertex, const Corner& corner, double limit, std::vector<RayLine>& rays) {
    rays.push_back({vertex, first_direction(corner)});
    if (!corner.fan) return;
    const double half = 0.5 * (corner.turning + corner.lean[1] - corner.lean[0]);
    const double middle = 0.5 * (corner.lean[0] + corner.lean[1]);
    const std::size_t spread = steps_for(2 * half, limit);
    for (std::size_t k = 1; k < spread; ++k) {
        const double share = (2.0 * static_cast<double>(k) - static_cast<double>(spread)) / static_cast<double>(spread);
        rays.push_back({vertex, unit(core::rotated(corner.bisector, middle + share * half))});
    }
    rays.push_back({vertex, last_direction(corner)});
}

/// The rays between two others on the edge between their origins.
class RaysBetween {
public:
    RaysBetween(const RayLine& first, const RayLine& last)
        : from_(first.origin), to_(last.origin), normal_(-perpendicular(unit(to_ - from_))) {
        // On either side of the edge's own normal every ray stays within 90 degrees.
        first_angle_ = core::angle_between(normal_, first.direction);
        last_angle_ = core::angle_between(normal_, last.direction);
    }
    double angle() const { return last_angle_ - first_angle_; }
    /// The ray at the share part / whole of the way, unless the edge is too short to be divided there in floating
    /// point.
    void add(double part, double whole, std::vector<RayLine>& rays) const {
        const double rest = whole - part;
        const Point origin{(rest * from_.x + part * to_.x) / whole, (rest * from_.y + part * to_.y) / whole};
        if (origin == rays.back().origin || origin == to_ || origin == from_) return;
        rays.push_back({origin, unit(core::rotated(normal_, (rest * first_angle_ + part * last_angle_) / whole))});
    }

private:
    Point from_, to_, normal_;
    double first_angle_ = 0, last_angle_ = 0;
};

void add_refining_rays(const RayLine& first, const RayLine& last, double limit, std::vector<RayLine>& rays) {
    const RaysBetween between(first, last);
    const std::size_t steps = steps_for(between.angle(), limit);
    for (std::size_t k = 1; k < steps; ++k) between.add(static_cast<double>(k), static_cast<double>(steps), rays);
}

/// A ray that ends early, and how.
struct Ending {
    double height;         ///< up to which it may go
    std::uint32_t layers;  ///< that fit
};

/// Shares of the way from one ray to another one, higher by several layers, at which to place a ray for each layer
/// between: the mean of even steps and of those at which a straight line between the heights passes the layers.
std::vector<double> steps_between(const Ending& low, const Ending& high, std::span<const double> heights) {
    std::vector<double> shares;
    const double layers = high.layers - low.layers;
    for (std::uint32_t n = low.layers + 1; n < high.layers; ++n) {
        const double even = (n - low.layers) / layers;
        const double at_height = (heights[n] - low.height) / (high.height - low.height);
        shares.push_back(0.5 * (even + std::clamp(at_height, 0.0, 1.0)));
    }
    return shares;
}

}  // namespace

std::vector<RayLine> make_rays(std::span<const Point> body, const LayerOptions& options, const LayerGrowth& growth) {
    std::vector<Corner> corners = make_corners(body, options);
    lean_in_concavities(body, growth, corners);
    const double limit = core::radians(options.max_ray_angle_deg);
    std::vector<RayLine> rays;
    rays.reserve(2 * body.size());
    for (std::size_t i = 0; i < body.size(); ++i) {
        const std::size_t next = (i + 1) % body.size();
        add_vertex_rays(body[i], corners[i], limit, rays);
        add_refining_rays(RayLine(rays.back()), {body[next], first_direction(corners[next])}, limit, rays);
    }
    return rays;
}

DividedRays insert_rays(const RaySet& set, const std::vector<std::vector<double>>& shares,
                        const std::vector<std::vector<double>>& factors) {
    const std::vector<std::size_t> next = set.following();
    DividedRays result;
    std::vector<RayLine>& lines = result.set.lines;
    for (std::size_t e = 0; e < set.elements(); ++e) {
        for (std::size_t i = set.begin[e]; i < set.begin[e + 1]; ++i) {
            const RayLine &ray = set.lines[i], &after = set.lines[next[i]];
            const bool divided = !shares[i].empty() && ray.origin != after.origin;
            const auto take_factor = [&](std::size_t k) {
                if (!factors.empty()) result.factors.resize(lines.size(), divided ? factors[i][k] : 0);
            };
            lines.push_back(ray);
            take_factor(0);
            if (!divided) continue;
            const RaysBetween between(ray, after);
            for (std::size_t k = 0; k < shares[i].size(); ++k) {
                between.add(shares[i][k], 1, lines);
                take_factor(k + 1);
            }
        }
        result.set.begin.push_back(lines.size());
    }
    return result;
}

RaySet add_rays_at_steps(const RaySet& set, const LayerHeights& heights, std::span<const double> limits) {
    const std::vector<std::size_t> next = set.following();
    const auto ending = [&](std::size_t i) {
        const std::span<const double> stack = heights.of(i);
        const auto above = std::upper_bound(stack.begin(), stack.end(), limits[i]);
        return Ending{std::min(limits[i], stack.back()), static_cast<std::uint32_t>(above - stack.begin()) - 1};
    };
    std::vector<std::vector<double>> shares(set.lines.size());
    for (std::size_t i = 0; i < set.lines.size(); ++i) {
        const Ending here = ending(i), there = ending(next[i]);
        if (here.layers < there.layers) {
            shares[i] = steps_between(here, there, heights.of(next[i]));
        } else {
            shares[i] = steps_between(there, here, heights.of(i));
            std::reverse(shares[i].begin(), shares[i].end());
            for (double& share : shares[i]) share = 1 - share;
        }
    }
    return insert_rays(set, shares).set;
}

}  // namespace lamina::layers

namespace lamina {

std::vector<std::size_t> RaySet::following() const {
    std::vector<std::size_t> next(lines.size());
    for (std::size_t e = 0; e < elements(); ++e)
        for (std::size_t i = begin[e]; i < begin[e + 1]; ++i) next[i] = i + 1 < begin[e + 1] ? i + 1 : begin[e];
    return next;
}

}  // namespace lamina
