// Concave corners: sharp ones have no ray, and the rays of others are shifted.
//
// The one ray of a sharp corner is so near to the walls on both sides that each cell beside it has an angle of 180
// degrees less half of the corner's, whatever its size. So such a corner has no ray, and the rays beside it are
// neighbours:
//
//                   _.-b       The column between the rays from a and b begins with three triangles:
//              _.-'   /        c, a, a' and b, c, b' have the first height, and c, a', b' has the
//         _.-'   _..-b'        angle of the corner. Rows go on above the edge from a' to b'.
//     c =:_------    |
//         `-._  ``--.a'
//              `-._   |
//                  `-._a
//
// docs/layer.md
#include "layers/directions/corners.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "layers/layered_rays.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// So many vertices on either side may be nearer to each other, and have no rays.
constexpr std::size_t most_vertices = 16;

/// An outline whose vertices are counted round and round.
class Outline {
public:
    explicit Outline(std::span<const RayVertex> vertices) : vertices_(vertices) {}

    std::size_t size() const { return vertices_.size(); }
    Point at(std::size_t i) const { return vertices_[i % size()].at; }
    bool is_wall(std::size_t i) const { return vertices_[i % size()].place == RayPlace::wall; }
    bool has_lines(std::size_t i) const { return !vertices_[i % size()].feet.empty(); }
    /// Returns the angle by which the outline turns at a vertex, in radians; > 0 where the body is convex.
    double turning(std::size_t i) const { return core::angle_between(at(i) - at(i + size() - 1), at(i + 1) - at(i)); }

private:
    std::span<const RayVertex> vertices_;
};

/// Returns the unit normal of the edge from a to b into the fluid.
Point normal_of(Point a, Point b) { return -perpendicular(unit(b - a)); }

/// Returns whether a point is well above these edges, by half of this height.
bool is_above_edges(const Outline& outline, Point p, std::size_t first, std::size_t count, double height) {
    constexpr double least_share = 0.5;  // rays lean farther than this tells: with 0.1 a triangle was folded
    for (std::size_t i = first; i < first + count; ++i)
        if (dot(normal_of(outline.at(i), outline.at(i + 1)), p - outline.at(i)) < least_share * height) return false;
    return true;
}

/// Returns whether the tops of the first layer beside a corner are well above the edges on their sides, which they are
/// not where a side bulges, or where a ray stands on a convex vertex and leans away, between the edge before it and the
/// way to the other ray:
///
///        a'          |
///         `.         |     a': top of the first layer; the edge from a to the corner c hides it
///      _____a\       |
///             \_ c __|b
///
bool sees_corner(const Outline& outline, std::size_t before, std::size_t corner, std::size_t after, double height) {
    const auto is_seen = [&](std::size_t vertex, std::size_t first, Point normal_before, Point normal_after) {
        const Point sum = normal_before + normal_after;
        return sum != Point{} &&
               is_above_edges(outline, outline.at(vertex) + height * unit(sum), first, corner - before, height);
    };
    const auto normal = [&](std::size_t edge) { return normal_of(outline.at(edge), outline.at(edge + 1)); };
    const Point across = normal_of(outline.at(before), outline.at(after));
    const Point above = normal(before + outline.size() - 1), below = normal(after);
    return is_seen(before, before, above, normal(before)) && is_seen(before, before, above, across) &&
           is_seen(after, corner, normal(after - 1), below) && is_seen(after, corner, across, below);
}

/// Returns how many vertices away from vertex i, on both sides, rays are to stand, where it is a sharp corner; else 0.
/// Vertices where lines end have rays.
std::size_t reach_of_corner(const Outline& outline, std::size_t i, double first_height) {
    const std::size_t n = outline.size();
    if (!outline.is_wall(i) || outline.turning(i) > -core::radians(180 - largest_sharp_deg)) return 0;
    for (std::size_t k = 1; k <= std::min({most_vertices, i, n - i}); ++k) {
        for (const std::size_t beside : {i + n - k + 1, i + k - 1})
            if (outline.has_lines(beside)) return 0;
        for (const std::size_t beside : {i + n - k, i + k})
            if (!outline.is_wall(beside + n - 1) || !outline.is_wall(beside) || !outline.is_wall(beside + 1)) return 0;
        if (distance(outline.at(i + n - k), outline.at(i + k)) < 2 * first_height) continue;
        return sees_corner(outline, i + n - k, i + n, i + n + k, first_height) ? k : 0;
    }
    return 0;
}

}  // namespace

void leave_out_sharp_corners(double first_height, std::vector<RayVertex>& outline) {
    if (outline.size() < 8 || !uses("sharp_corners")) return;
    struct Corner {
        std::size_t at, reach;
        bool meets(const Corner& next) const { return at + reach > next.at - next.reach; }
    };
    std::vector<Corner> corners;
    for (std::size_t i = 1; i < outline.size(); ++i)
        if (const std::size_t reach = reach_of_corner(Outline(outline), i, first_height)) corners.push_back({i, reach});
    std::vector<RayVertex> kept;
    std::size_t done = 0;  // up to this vertex
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const Corner& corner = corners[c];
        // Corners that are too near to each other stay.
        if ((c > 0 && corners[c - 1].meets(corner)) || (c + 1 < corners.size() && corner.meets(corners[c + 1])))
            continue;
        const auto vertex = [&](std::size_t i) { return outline.begin() + static_cast<std::ptrdiff_t>(i); };
        const std::size_t before = corner.at - corner.reach, after = corner.at + corner.reach;
        kept.insert(kept.end(), vertex(done), vertex(before + 1));
        for (std::size_t i = before + 1; i < after; ++i) kept.back().corner_after.push_back(outline[i].at);
        done = after;
    }
    kept.insert(kept.end(), outline.begin() + static_cast<std::ptrdiff_t>(done), outline.end());
    // Each vertex has a ray, or is a corner after one.
    assert(std::accumulate(kept.begin(), kept.end(), kept.size(), [](std::size_t sum, const RayVertex& v) {
               return sum + v.corner_after.size();
           }) == outline.size());
    outline = std::move(kept);
}

// The ray of a corner that leans, so that it meets its neighbours higher up (leans.hpp), is too high
// above one of the edges beside it and too low above the other. It leaves the corner along the bisector instead, up to
// the top of the first layer, and bends into its direction above it (docs/layer.md):
//
//     \      /           \      /
//      \    /             \    /      o: top of the first layer. Left: on a ray that leans to the right, too low above
//       \  o               \  o       the wall on the right. Right: as high above that wall as above the other one.
//        \/______           \|______
//
// The ray is a hyperbola: at the height h it lies beside its line by h / (h + b) of a shift. Where the first layer, of
// the height f, is to lie beside it by a vector s, and the shift is k s, b is (k - 1) f. The larger k is, the smaller
// are the angles between a layer and the next one; all layers are shifted by s alone with k = 1.

namespace {

/// Shifts the one ray of a vertex, but not where first heights are right without a shift, and where the wall
/// hardly turns. along: first height along the ray; height: above the edges.
void shift_at_corner(const RayLine& before, RayLine& ray, const RayLine& after, double along, double height) {
    constexpr double negligible = 1e-6;  // radians: leans are multiples of far larger steps
    ray.shift = {};
    ray.half_shift = 0;
    const WallNeighbours vertices = wall_neighbours(before, ray, after);
    const Point edge_before = ray.origin - vertices.before, edge_after = vertices.after - ray.origin;
    const Point a = -perpendicular(unit(edge_before)), b = -perpendicular(unit(edge_after));
    const auto is_kept = [&](Point normal) {
        return std::abs(dot(normal, ray.direction) * along - height) <= kept_difference * height;
    };
    if (is_kept(a) && is_kept(b)) return;
    if (std::abs(core::angle_between(a, b)) <= core::radians(max_smooth_turning_deg)) return;
    // Both edges, moved outwards by the height, meet at the top of the first layer.
    const Point top = height / (1 + dot(a, b)) * (a + b), shift = top - along * ray.direction;
    const double shorter = std::min(length(edge_before), length(edge_after));
    if (!(length(shift) <= most_shift * shorter)) return;
    // A ray in the bisector, too high above both edges or too low, has nowhere to bend to.
    const bool leans = std::abs(cross(top, ray.direction)) > negligible * length(top);
    const double times = leans ? std::clamp(most_bend * shorter / length(shift), 1.0, most_shift_over_first) : 1;
    ray.shift = times * shift;
    ray.half_shift = (times - 1) * along;
}

/// Returns the largest lean of the one ray of a vertex, in radians, at which it is higher above one of the edges at its
/// origin than above the other by no more than twice kept_difference of their mean. A ray that leans by t where the
/// wall turns by 2 b is cos(t + b) / (cos t cos b) = 1 - tan t tan b times that mean above one edge, 1 + tan t tan b
/// times above the other.
double max_unshifted_lean(double turning) {
    const double b = 0.5 * std::abs(turning);
    return core::atan2_reproducible(kept_difference * core::cos_reproducible(b), core::sin_reproducible(b));
}

}  // namespace

double max_lean_between_edges(double turning, double first_height, double shorter_edge) {
    if (std::abs(turning) <= core::radians(max_smooth_turning_deg)) return max_unshifted_lean(turning);
    // The shift of a ray that leans by t, where the wall turns by 2 b, is first_height tan t / cos b long.
    const double longest = most_shift * shorter_edge;
    const double shifted = core::atan2_reproducible(longest * core::cos_reproducible(0.5 * turning), first_height);
    return std::max(shifted, max_unshifted_lean(turning));
}

void shift_rays_of_corners(const LayerGrowth& growth, RaySet& set) {
    if (!uses("corner_shifts")) return;
    const RayNeighbours neighbours(set);
    std::size_t element = 0;
    for (std::size_t i = 0; i < set.lines.size(); ++i) {
        while (i == set.begin[element + 1]) ++element;
        RayLine& ray = set.lines[i];
        const RayLine &before = set.lines[neighbours.previous[i]], &after = set.lines[neighbours.next[i]];
        if (ray.place != RayPlace::wall) continue;
        if (before.origin == ray.origin || after.origin == ray.origin) continue;  // a ray of a fan
        const double above = ray.opening * growth.first_height_on(element), along = ray.slant * above;
        shift_at_corner(before, ray, after, along, above);
        if (ray.on_symmetry) ray.shift.y = 0;
    }
}

}  // namespace lamina::layers
