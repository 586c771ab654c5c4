// The one ray of a sharp corner is so near to the walls on both sides that each cell beside it has an angle of 180 degrees
// less half of the corner's, whatever its size. So such a corner has no ray, and the rays beside it are neighbours:
//
//                   _.-b
//              _.-'   /        The column between the rays from a and b begins with three triangles: c, a, a' and b, c, b'
//         _.-'   _..-b'        have the first height, and c, a', b' has the angle of the corner. Rows go on above a'-b'.
//     c =:_------    |
//         `-._  ``--.a'
//              `-._   \
//                  `-._a
//
// docs/decisions/0070
#include "layers/sharp_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/angles.hpp"

namespace lamina::layers {

namespace {

/// Walls meet at this angle or less, in degrees. Half of it is what is left to 180 degrees in the cells beside its ray.
constexpr double largest_sharp_deg = 60;
/// Beside the corner the wall turns by this at most, in degrees, so that rays may lean out of it.
constexpr double most_turning_beside_deg = 30;
/// The largest angle of the triangle at the corner, in degrees.
constexpr double largest_at_corner_deg = 140;
/// The vertices beside the corner are this many first heights apart at least.
constexpr double least_width = 3;

/// Returns the angle by which an outline turns from a to c at b, in radians; > 0 where the body is convex.
double turning(Point a, Point b, Point c) { return core::angle_between(b - a, c - b); }

/// Returns whether the cells of the first layer fit into a corner at c, between vertices a before it and b behind it.
bool first_layer_fits(Point a, Point c, Point b, double first_height) {
    const double largest =
        std::max(std::abs(core::angle_between(a - c, a - b)), std::abs(core::angle_between(b - c, b - a)));
    return distance(a, b) >= least_width * first_height && largest <= core::radians(largest_at_corner_deg);
}

}  // namespace

void leave_out_sharp_corners(double first_height, std::vector<RayVertex>& outline) {
    const std::size_t n = outline.size();
    if (n < 8) return;
    const auto vertex = [&](std::size_t i) -> const RayVertex& { return outline[i % n]; };
    const auto is_sharp = [&](std::size_t i) {
        for (std::size_t k = i + n - 2; k <= i + n + 2; ++k)
            if (vertex(k).place != RayPlace::wall) return false;
        const auto turning_at = [&](std::size_t k) {
            return turning(vertex(k - 1).at, vertex(k).at, vertex(k + 1).at);
        };
        const double beside = std::max(std::abs(turning_at(i + n - 1)), std::abs(turning_at(i + n + 1)));
        return turning_at(i + n) <= -core::radians(180 - largest_sharp_deg) &&
               beside <= core::radians(most_turning_beside_deg) &&
               first_layer_fits(vertex(i + n - 1).at, vertex(i).at, vertex(i + 1).at, first_height);
    };
    std::vector<RayVertex> kept{outline.front()};
    for (std::size_t i = 1; i < n; ++i) {
        if (is_sharp(i))
            kept.back().corner_after = outline[i].at;
        else
            kept.push_back(outline[i]);
    }
    outline = std::move(kept);
}

}  // namespace lamina::layers
