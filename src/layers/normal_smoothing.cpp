// Rays along the bisectors of a concave corner, or of a noisy stretch of wall, would meet close to the wall. They may
// turn towards each other by no more than 1 in (clearance x height of the layers) along the wall, which counts less the
// more they lean (upright_distance()). The turning beyond that is spread over the rays on both sides, which are tilted
// out of the corner (docs/decisions/0011). On outlines with a wake, narrow columns are spread in the same way (0037).
// Convex corners of one ray give their angle to the rays on short edges beside them, which else would be divided (0061).
#include "layers/normal_smoothing.hpp"

#include <algorithm>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "layers/corner_shifts.hpp"
#include "layers/heights.hpp"
#include "layers/mechanisms.hpp"
#include "layers/short_faces.hpp"

namespace lamina::layers {

namespace {

/// Rays may meet no nearer to the wall than at this many heights of the layers. A ray ends at 0.45 of the way to a ray
/// that it meets (ray_fraction in truncation.cpp), so that all layers fit below.
constexpr double clearance = 2.25;
/// On outlines with a wake columns should keep more of their width: they count this many times their least height.
constexpr double wide_clearance = 5;
/// There columns spread until they are at least this share of their least height wide.
constexpr double min_width = 1.0 / 50;
/// Layers thicker than this share of the outline's perimeter do not tilt its rays any further.
constexpr double max_thickness_share = 0.05;
/// Largest tilt of a ray to either side of the bisector, in degrees, unless it stands on a short face or in a fan.
constexpr double max_tilt_deg = 45;
/// Both ends of a fan together may take this share of its angle. Above the riser of a step, or on a horn of ice, all rays
/// lean, and a fan whose rays did not would meet them.
constexpr double share_of_fan = 0.75;

/// Rays lean towards the one ray of a corner where edges are shorter than this share of the height to keep clear: there
/// the columns beside it begin like a fan.
constexpr double short_edge_share = 0.2;
/// Largest tilt for the sake of such corners, in degrees.
constexpr double max_corner_tilt_deg = 25;

/// Returns the height below which the rays of an outline should not meet.
double height_to_keep_clear(std::span<const RayVertex> outline, const LayerGrowth& growth) {
    double perimeter = 0, edges = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const RayVertex &a = outline[i], &b = outline[(i + 1) % outline.size()];
        if (a.place != RayPlace::wall || b.place != RayPlace::wall) continue;
        perimeter += distance(a.at, b.at);
        ++edges;
    }
    const double spacing = perimeter / edges;
    return std::min(expected_height(growth, spacing), max_thickness_share * perimeter);
}

/// Where in the fan of its vertex a ray stands.
enum class FanEnd : char { none, first, last };

/// The ray of a vertex, or the first or last one of a fan.
struct TiltableRay {
    FanEnd fan_end;
    double* tilt;                 ///< the entry of WallVertex::tilt that is to be set
    double max_tilt;              ///< to either side, in radians; in fans, where both ends ask for as much
    double max_share_of_corners;  ///< what spread_corners() may add to the tilt, in radians
    double turning;               ///< angle to the next ray, in radians
    double distance;              ///< to the origin of the next ray, along the wall
    double clear;                 ///< height below which it should not meet the next ray
    double least;                 ///< least height of the column up to the next ray, where it is to spread; 0 elsewhere
    double opening;       ///< angle by which the rays are to diverge up to the next one on a short face, in radians
    double to_normals;    ///< angle from the ray, not tilted, to the normals of the edges on both sides, in radians
    bool shares_corners;  ///< whether the edge up to the next ray is so short that corners are spread over it
};

/// Returns the largest tilt of the one ray of a vertex: `most` at a corner, and where the wall turns by little
/// `most_between_edges`, too.
double max_tilt_of_bisector(const WallVertex& vertex, double most, double most_between_edges) {
    const double b = 0.5 * std::abs(vertex.turning);
    double tilt = std::min(most, core::radians(max_angle_from_normal_deg) - b);
    if (2 * b <= core::radians(max_smooth_turning_deg)) tilt = std::min(tilt, most_between_edges);
    return std::max(tilt, 0.0);
}

std::vector<TiltableRay> tiltable_rays(std::span<const RayVertex> outline, double clear, double first_height,
                                       OutlineKind kind, std::vector<WallVertex>& vertices) {
    // Fans round bases without a wake spread by themselves.
    const bool wake = has_wake(outline);
    const std::vector<double> openings = kind == OutlineKind::smooth && !wake
                                             ? openings_on_short_faces(outline, vertices)
                                             : std::vector<double>(outline.size(), 0.0);
    std::vector<TiltableRay> rays;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t next = (i + 1) % outline.size();
        WallVertex &vertex = vertices[i], &after = vertices[next];
        const std::size_t before = (i + outline.size() - 1) % outline.size();
        const RayVertex &a = outline[i], &b = outline[next];
        const double apart = distance(a.at, b.at);
        const bool on_face = openings[before] > 0 || openings[i] > 0;
        const double most = core::radians(on_face ? max_angle_from_normal_deg : max_tilt_deg);
        const double shorter = std::min(distance(outline[before].at, a.at), apart);
        const double most_between_edges = max_tilt_between_edges(vertex.turning, kind, first_height, shorter);
        const double max_tilt =
            vertex.fan ? 0.5 * share_of_fan * vertex.turning : max_tilt_of_bisector(vertex, most, most_between_edges);
        const double max_share_of_corners = std::min(core::radians(max_corner_tilt_deg),
                                                     vertex.fan ? max_tilt : max_tilt_between_edges(vertex.turning));
        if (vertex.fan)
            rays.push_back({FanEnd::first, &vertex.tilt[0], max_tilt, max_share_of_corners, vertex.turning, 0, clear, 0,
                            0, 0, false});
        const double to_normals = vertex.fan ? 0 : 0.5 * vertex.turning;
        const double turning = to_normals + (after.fan ? 0 : 0.5 * after.turning);
        const double least = wake ? std::max(a.least_height, b.least_height) : 0;
        rays.push_back({vertex.fan ? FanEnd::last : FanEnd::none, &vertex.tilt[vertex.fan], max_tilt,
                        max_share_of_corners, turning, apart, std::max(clear, wide_clearance * least), least,
                        openings[i], to_normals, !wake && apart < short_edge_share * clear});
    }
    return rays;
}

/// Returns the distance from a ray to the next one, as wide as it is seen along the rays and as high as they meet above
/// the wall: rays that leave the wall at an angle b from its normal are cos b times as far apart, and meet cos b times
/// as high.
double upright_distance(const TiltableRay& ray, const TiltableRay& next) {
    const double angle = std::max(std::abs(*ray.tilt - ray.to_normals), std::abs(*next.tilt + next.to_normals));
    const double c = core::cos_reproducible(std::min(angle, core::radians(max_angle_from_normal_deg)));
    return c * c * ray.distance;
}

/// Returns, for each ray, half of what the excesses before it add up to, less half of those behind it. The excess at i is
/// that of the angle from ray i to the next one; carried on, it shrinks where there is room and never falls below 0.
std::vector<double> carried_excess(std::span<const double> excess) {
    const std::size_t n = excess.size();
    std::vector<double> before(n, 0.0), behind(n, 0.0);
    // Each loop goes round twice, since the first round must carry its end over to its start.
    for (std::size_t k = 0; k < 2 * n; ++k) {
        const std::size_t i = k % n, j = n - 1 - i;
        before[(i + 1) % n] = std::max(0.0, before[i] + excess[i]);
        behind[j] = std::max(0.0, behind[(j + 1) % n] + excess[j]);
    }
    for (std::size_t i = 0; i < n; ++i) before[i] = 0.5 * (before[i] - behind[i]);
    return before;
}

/// Returns the largest tilt of a ray, given the offsets that all rays ask for. One end of a fan may take what the other
/// leaves.
double largest_tilt(std::span<const TiltableRay> rays, std::span<const double> offsets, std::size_t i) {
    const TiltableRay& ray = rays[i];
    if (ray.fan_end == FanEnd::none) return ray.max_tilt;
    const double other = std::abs(offsets[ray.fan_end == FanEnd::first ? i + 1 : i - 1]);
    return std::min(core::radians(max_angle_from_normal_deg), 2 * ray.max_tilt - std::min(other, ray.max_tilt));
}

/// Tilts the rays so that from one to the next none falls by more than is allowed, or rises by less than makes their
/// column wide enough. Let a(s) be the angle of the bisectors along the wall. What is carried from before is how far the
/// least function above a that falls no faster than allowed lies above a, what is carried from behind how far the greatest
/// such function below a lies below it. The mean of the two functions falls no faster either, equals a where a itself is
/// admissible, and treats both directions of the wall alike. The tilt is the difference between this mean and a.
void tilt(std::span<const TiltableRay> rays) {
    const std::size_t n = rays.size();
    std::vector<double> excess(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double apart = upright_distance(rays[i], rays[(i + 1) % n]);
        double min_rise = -(1 / (clearance * rays[i].clear)) * apart;
        if (rays[i].least > 0 && apart > 0) min_rise = std::max(min_rise, min_width - apart / rays[i].least);
        if (rays[i].opening > 0) min_rise = rays[i].opening;
        excess[i] = min_rise - rays[i].turning;
    }
    const std::vector<double> offsets = carried_excess(excess);
    for (std::size_t i = 0; i < n; ++i) {
        const double largest = largest_tilt(rays, offsets, i);
        *rays[i].tilt = std::clamp(offsets[i], -largest, largest);
    }
}

/// Tilts the rays so that from one to the next on a short edge none rises by more than max_angle. As in tilt(), the angle
/// becomes the mean of the least function above it and the greatest one below it that rise no faster:
///
///        __ normals              __ spread
///       |                      _/
///     __|                   __/
///       corner                corner
///
/// Where a falls no faster than is allowed, neither function does.
void spread_corners(std::span<const TiltableRay> rays, double max_angle) {
    constexpr int rounds = 3;  // what one ray may not take is left to others
    const std::size_t n = rays.size();
    std::vector<double> spread(n, 0.0), excess(n);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t next = (i + 1) % n;
            const double turning = rays[i].turning + *rays[next].tilt + spread[next] - *rays[i].tilt - spread[i];
            excess[i] = rays[i].shares_corners ? turning - max_angle : -core::pi;
        }
        const std::vector<double> offsets = carried_excess(excess);
        for (std::size_t i = 0; i < n; ++i)
            spread[i] = std::clamp(spread[i] - offsets[i], -rays[i].max_share_of_corners, rays[i].max_share_of_corners);
    }
    for (std::size_t i = 0; i < n; ++i) {
        const double largest = std::max(rays[i].max_tilt, std::abs(*rays[i].tilt));
        *rays[i].tilt = std::clamp(*rays[i].tilt + spread[i], -largest, largest);
    }
}

}  // namespace

// A ray that is tilted by t where the wall turns by 2 b is cos(t + b) / (cos t cos b) = 1 - tan t tan b times the mean of
// both heights above one edge, 1 + tan t tan b times above the other.
double max_tilt_between_edges(double turning) {
    constexpr double max_height_difference = 0.009;
    const double b = 0.5 * std::abs(turning);
    return core::atan2_reproducible(max_height_difference * core::cos_reproducible(b), core::sin_reproducible(b));
}

double angle_to_next(const WallVertex& vertex, const WallVertex& next) {
    const double between_bisectors = (vertex.fan ? 0 : 0.5 * vertex.turning) + (next.fan ? 0 : 0.5 * next.turning);
    return between_bisectors + next.tilt[0] - vertex.tilt[1];
}

void smooth_normals(std::span<const RayVertex> outline, const LayerGrowth& growth, double max_angle, OutlineKind kind,
                    std::vector<WallVertex>& vertices) {
    constexpr int rounds = 3;  // the tilts of one decide the distances of the next
    const bool concave =
        std::any_of(vertices.begin(), vertices.end(), [](const WallVertex& v) { return v.turning < 0; });
    if (!concave && growth.least_heights.empty()) return;
    const std::vector<TiltableRay> rays =
        tiltable_rays(outline, height_to_keep_clear(outline, growth), growth.first_height, kind, vertices);
    if (uses("tilt"))
        for (int round = 0; round < rounds; ++round) tilt(rays);
    if (uses("spread_corners")) spread_corners(rays, max_angle);
    for (WallVertex& vertex : vertices)
        if (!vertex.fan) vertex.tilt[1] = vertex.tilt[0];
}

}  // namespace lamina::layers
