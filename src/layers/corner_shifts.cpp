// The ray of a corner that leans, so that it meets its neighbours higher up (leans.hpp), is too high
// above one of the edges beside it and too low above the other. It leaves the corner along the bisector instead, up to
// the top of the first layer, and leans from there on (docs/layer.md):
//
//     \      /           \      /
//      \    /             \    /      o: top of the first layer. Left: on a ray that leans to the right, too low above
//       \  o               \  o       the wall on the right. Right: as high above that wall as above the other one.
//        \/______           \|______
//
// Rows above are shifted as much, a part of the height of the first layer.
#include "layers/corner_shifts.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "layers/mechanisms.hpp"
#include "layers/neighbours.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// First heights that differ by less from the one wanted stay as they are: leans where walls are smooth may cost 0.009
/// (max_lean_between_edges()).
constexpr double kept_difference = 0.0095;
/// Largest shift, as a share of the shorter edge at the corner: far from what would make cells cross each other.
constexpr double most_shift = 0.2;

/// Returns the shift of a ray of its own at a vertex; none where the wall turns by least_turning or less, in radians.
/// along: first height along the ray; height: above the edges.
Point shift_at_corner(const RayLine& before, const RayLine& ray, const RayLine& after, double along, double height,
                      double least_turning) {
    const WallNeighbours vertices = wall_neighbours(before, ray, after);
    const Point edge_before = ray.origin - vertices.before, edge_after = vertices.after - ray.origin;
    const Point a = -perpendicular(unit(edge_before)), b = -perpendicular(unit(edge_after));
    if (std::abs(core::angle_between(a, b)) <= least_turning) return {};
    const auto is_kept = [&](Point normal) {
        return std::abs(dot(normal, ray.direction) * along - height) <= kept_difference * height;
    };
    if (is_kept(a) && is_kept(b)) return {};
    // Both edges, moved outwards by the height, meet there.
    const Point shift = height / (1 + dot(a, b)) * (a + b) - along * ray.direction;
    const double shorter = std::min(length(edge_before), length(edge_after));
    return length(shift) <= most_shift * shorter ? shift : Point{};
}

/// Returns the largest lean of the one ray of a vertex, in radians, at which it is higher above one of the edges at its origin
/// than above the other by no more than twice 0.009 of their mean. A ray that leans by t where the wall turns by 2 b is
/// cos(t + b) / (cos t cos b) = 1 - tan t tan b times that mean above one edge, 1 + tan t tan b times above the other.
double max_unshifted_lean(double turning) {
    constexpr double max_height_difference = 0.009;
    const double b = 0.5 * std::abs(turning);
    return core::atan2_reproducible(max_height_difference * core::cos_reproducible(b), core::sin_reproducible(b));
}

/// Where smooth walls turn by less, in degrees, first cells are long, and neighbours may keep what differs a little.
constexpr double max_smooth_turning_deg = 6;

}  // namespace

double max_lean_between_edges(double turning, OutlineKind kind, double first_height, double shorter_edge) {
    if (kind != OutlineKind::jagged && std::abs(turning) <= core::radians(max_smooth_turning_deg))
        return max_unshifted_lean(turning);
    constexpr double slack = 0.9;  // first layers are a little higher where neighbours lean
    // The shift of a ray that leans by t, where the wall turns by 2 b, is first_height tan t / cos b long.
    const double longest = slack * most_shift * shorter_edge;
    const double shifted = core::atan2_reproducible(longest * core::cos_reproducible(0.5 * turning), first_height);
    return std::max(shifted, max_unshifted_lean(turning));
}

void shift_rays_of_corners(std::span<const char> jagged, const LayerGrowth& growth, RaySet& set) {
    if (!uses("corner_shifts")) return;
    const RayNeighbours neighbours(set);
    std::size_t element = 0;
    for (std::size_t i = 0; i < set.lines.size(); ++i) {
        while (i == set.begin[element + 1]) ++element;
        RayLine& ray = set.lines[i];
        const RayLine &before = set.lines[neighbours.previous[i]], &after = set.lines[neighbours.next[i]];
        const auto on_wall = [](const RayLine& line) { return line.place == RayPlace::wall; };
        if (!on_wall(before) || !on_wall(ray) || !on_wall(after)) continue;
        if (before.origin == ray.origin || after.origin == ray.origin) continue;  // a ray of a fan
        const double least_turning = jagged[element] ? 0 : core::radians(max_smooth_turning_deg);
        const double above = ray.opening * growth.first_height_on(element), along = ray.slant * above;
        ray.shift = shift_at_corner(before, ray, after, along, above, least_turning);
    }
}

}  // namespace lamina::layers
