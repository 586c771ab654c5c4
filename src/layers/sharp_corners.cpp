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
#include "layers/sharp_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "core/angles.hpp"
#include "layers/mechanisms.hpp"

namespace lamina::layers {

namespace {

/// Walls meet at this angle or less, in degrees. Half of it is what is left to 180 degrees in the cells beside its ray.
constexpr double largest_sharp_deg = 60;
/// Beside the corner the wall turns by this at most, in degrees, so that rays may lean out of it.
constexpr double most_turning_beside_deg = 30;
/// The largest angle of the triangle at the corner, in degrees.
constexpr double largest_at_corner_deg = 140;
/// The vertices beside the corner that have rays are this many first heights apart at least.
constexpr double least_chord = 3;
/// So many vertices on either side may be nearer to each other, and have no rays.
constexpr std::size_t most_vertices = 16;

/// An outline whose vertices are counted round and round.
class Outline {
public:
    explicit Outline(std::span<const RayVertex> vertices) : vertices_(vertices) {}

    std::size_t size() const { return vertices_.size(); }
    Point at(std::size_t i) const { return vertices_[i % size()].at; }
    bool is_wall(std::size_t i) const { return vertices_[i % size()].place == RayPlace::wall; }
    /// Returns the angle by which the outline turns at a vertex, in radians; > 0 where the body is convex.
    double turning(std::size_t i) const { return core::angle_between(at(i) - at(i + size() - 1), at(i + 1) - at(i)); }

private:
    std::span<const RayVertex> vertices_;
};

/// Returns whether the cells of the first layer fit into a corner at c, between vertices a before it and b behind it.
bool first_layer_fits(Point a, Point c, Point b, double first_height) {
    const double largest =
        std::max(std::abs(core::angle_between(a - c, a - b)), std::abs(core::angle_between(b - c, b - a)));
    return distance(a, b) >= least_chord * first_height && largest <= core::radians(largest_at_corner_deg);
}

/// Returns how many vertices away from vertex i, on both sides, rays are to stand, where it is a sharp corner; else 0.
std::size_t reach_of_corner(const Outline& outline, std::size_t i, double first_height) {
    const std::size_t n = outline.size();
    if (!outline.is_wall(i) || outline.turning(i) > -core::radians(180 - largest_sharp_deg)) return 0;
    for (std::size_t k = 1; k <= std::min({most_vertices, i, n - i}); ++k) {
        for (const std::size_t beside : {i + n - k, i + k})
            if (!outline.is_wall(beside + n - 1) || !outline.is_wall(beside) || !outline.is_wall(beside + 1) ||
                std::abs(outline.turning(beside)) > core::radians(most_turning_beside_deg))
                return 0;
        if (first_layer_fits(outline.at(i + n - k), outline.at(i), outline.at(i + k), first_height)) return k;
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
    outline = std::move(kept);
}

}  // namespace lamina::layers
