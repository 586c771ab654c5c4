#include "surface/noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "surface/corners.hpp"

namespace lamina::surface {

std::vector<bool> find_zigzags(std::span<const double> turning, double min_turning) {
    const std::size_t n = turning.size();
    std::vector<bool> zigzags(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double before = turning[(i + n - 1) % n], after = turning[(i + 1) % n];
        zigzags[i] = std::min({std::abs(turning[i]), std::abs(before), std::abs(after)}) > min_turning &&
                     turning[i] * before < 0 && turning[i] * after < 0;
    }
    return zigzags;
}

NoiseEstimate estimate_noise(std::span<const Point> outline, std::span<const std::size_t> corners) {
    constexpr double min_turning = core::radians(0.2);
    const std::size_t n = outline.size();
    std::vector<double> turning = turning_angles(outline);
    for (std::size_t corner : corners) turning[corner] = 0;
    const std::vector<bool> zigzags = find_zigzags(turning, min_turning);
    NoiseEstimate noise;
    for (std::size_t i = 0; i < n; ++i) {
        if (!zigzags[i]) continue;
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const double angle = std::abs(turning[i]);
        ++noise.vertices;
        noise.max_turning = std::max(noise.max_turning, angle);
        // A vertex that moves aside by d turns by d (1/l + 1/m) more, where l and m are the lengths of its edges. Half
        // of the turning comes from its neighbours, which moved to the other side.
        const double l = distance(outline[before], outline[i]), m = distance(outline[i], outline[after]);
        noise.amplitude = std::max(noise.amplitude, 0.5 * angle / (1 / l + 1 / m));
    }
    return noise;
}

//            i
//           / .            The outline turns right at i and left on both sides of it; without i it hardly turns.
//     -----o   o-----
//      before  after
std::vector<std::size_t> find_misplaced_points(std::span<const Point> outline) {
    constexpr double min_turning = core::radians(15), max_share_without = 1.0 / 3;
    const std::size_t n = outline.size();
    std::vector<std::size_t> misplaced;
    if (n < 8) return misplaced;
    const std::vector<double> turning = turning_angles(outline);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const double angle = std::abs(turning[i]);
        if (angle < min_turning || turning[i] * turning[before] >= 0 || turning[i] * turning[after] >= 0) continue;
        const Point a = outline[(before + n - 1) % n], b = outline[before], c = outline[after],
                    d = outline[(after + 1) % n];
        const double turning_without =
            std::max(std::abs(core::angle_between(b - a, c - b)), std::abs(core::angle_between(c - b, d - c)));
        if (turning_without < max_share_without * angle) misplaced.push_back(i);
    }
    return misplaced;
}

}  // namespace lamina::surface
