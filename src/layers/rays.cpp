// Vertex normals, fans and refining rays. Source: J. K. Pardue, thesis (2015), chapter 3 and section 3.1.
#include "layers/rays.hpp"

#include <algorithm>
#include <cmath>

#include "core/reproducible_math.hpp"

namespace lamina {
namespace {

/// Slack on the number of steps, so that an angle of exactly the limit is not divided.
constexpr double step_slack = 1e-9;

Point rotated(Point a, double angle) {
    const double c = cos_reproducible(angle), s = sin_reproducible(angle);
    return {a.x * c - a.y * s, a.x * s + a.y * c};
}

double angle_between(Point from, Point to) { return atan2_reproducible(cross(from, to), dot(from, to)); }

std::size_t steps_for(double angle, double limit) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(std::abs(angle) / limit - step_slack)));
}

/// What surrounds one vertex of the body.
struct Corner {
    double turning;      ///< > 0 where the body is convex
    Point before;        ///< outward normal of the edge that arrives
    Point after;         ///< ... of the edge that leaves
    Point bisector;      ///< outward
    bool fan;            ///< several rays
    std::size_t spread;  ///< steps from `before` to `after`
};

/// The sum of the two normals vanishes as the edges fold onto each other; the difference of the tangents does not.
Point bisector(Point tangent_before, Point tangent_after, double turning) {
    if (std::abs(turning) < 0.5 * pi) return unit(-perpendicular(tangent_before) - perpendicular(tangent_after));
    return turning > 0 ? unit(tangent_before - tangent_after) : unit(tangent_after - tangent_before);
}

std::vector<Corner> make_corners(std::span<const Point> body, const LayerOptions& options) {
    const std::size_t n = body.size();
    std::vector<Corner> corners(n);
    Point before = unit(body[0] - body[n - 1]);
    for (std::size_t i = 0; i < n; ++i) {
        const Point after = unit(body[(i + 1) % n] - body[i]);
        const double turning = angle_between(before, after);
        const bool fan = options.corners == Corners::fan && turning > radians(sharp_corner_deg);
        corners[i] = {turning,
                      -perpendicular(before),
                      -perpendicular(after),
                      bisector(before, after, turning),
                      fan,
                      fan ? steps_for(turning, radians(options.max_ray_angle_deg)) : 0};
        before = after;
    }
    return corners;
}

/// The fan is turned out of the bisector, not from one side to the other, so that mirrored input gives mirrored rays.
void add_vertex_rays(Point vertex, const Corner& corner, std::vector<RayLine>& rays) {
    if (!corner.fan) {
        rays.push_back({vertex, corner.bisector});
        return;
    }
    rays.push_back({vertex, corner.before});
    for (std::size_t k = 1; k < corner.spread; ++k) {
        const double share = (2.0 * static_cast<double>(k) - static_cast<double>(corner.spread)) /
                             (2.0 * static_cast<double>(corner.spread));
        rays.push_back({vertex, unit(rotated(corner.bisector, share * corner.turning))});
    }
    rays.push_back({vertex, corner.after});
}

/// Angles are measured from the edge's own normal, on either side of which every ray stays within 90 degrees.
void add_refining_rays(Point from, Point to, Point normal, Point first, Point last, double limit,
                       std::vector<RayLine>& rays) {
    const double a = angle_between(normal, first), b = angle_between(normal, last);
    const std::size_t steps = steps_for(b - a, limit);
    const double n = static_cast<double>(steps);
    for (std::size_t k = 1; k < steps; ++k) {
        const double t = static_cast<double>(k);
        const Point origin{((n - t) * from.x + t * to.x) / n, ((n - t) * from.y + t * to.y) / n};
        // Edges too short to be divided in floating point keep their coarser angle.
        if (origin == rays.back().origin || origin == to) continue;
        rays.push_back({origin, unit(rotated(normal, ((n - t) * a + t * b) / n))});
    }
}

}  // namespace

std::vector<std::size_t> RaySet::following() const {
    std::vector<std::size_t> next(rays.size());
    for (std::size_t e = 0; e < bodies(); ++e)
        for (std::size_t i = begin[e]; i < begin[e + 1]; ++i) next[i] = i + 1 < begin[e + 1] ? i + 1 : begin[e];
    return next;
}

std::vector<RayLine> make_rays(std::span<const Point> body, const LayerOptions& options) {
    const std::vector<Corner> corners = make_corners(body, options);
    const double limit = radians(options.max_ray_angle_deg);
    std::vector<RayLine> rays;
    rays.reserve(2 * body.size());
    for (std::size_t i = 0; i < body.size(); ++i) {
        const std::size_t next = (i + 1) % body.size();
        add_vertex_rays(body[i], corners[i], rays);
        const Corner& end = corners[next];
        add_refining_rays(body[i], body[next], corners[i].after, rays.back().direction,
                          end.fan ? end.before : end.bisector, limit, rays);
    }
    return rays;
}

}  // namespace lamina
