#include "surface/noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "surface/corners.hpp"

namespace lamina::surface {

Noise find_noise(std::span<const Point> outline, std::span<const std::size_t> corners) {
    constexpr double least_turning = core::radians(0.2);
    const std::size_t n = outline.size();
    std::vector<double> turning = turnings(outline);
    for (std::size_t corner : corners) turning[corner] = 0;
    Noise noise;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const double angle = std::abs(turning[i]);
        const double least = std::min({angle, std::abs(turning[before]), std::abs(turning[after])});
        if (least < least_turning || turning[i] * turning[before] > 0 || turning[i] * turning[after] > 0) continue;
        ++noise.vertices;
        noise.turning = std::max(noise.turning, angle);
        // A vertex moved aside by d turns by d (1/l + 1/m) more, l and m its edges; half of it is its neighbours'
        // doing.
        const double l = distance(outline[before], outline[i]), m = distance(outline[i], outline[after]);
        noise.amplitude = std::max(noise.amplitude, 0.5 * angle / (1 / l + 1 / m));
    }
    return noise;
}

//            i
//           / .            turning to the right at i, to the left on both sides of it; without i hardly at all
//     -----o   o-----
//      before  after
std::vector<std::size_t> find_misplaced(std::span<const Point> outline) {
    constexpr double least_turning = core::radians(15), share_without = 1.0 / 3;
    const std::size_t n = outline.size();
    std::vector<std::size_t> misplaced;
    if (n < 8) return misplaced;
    const std::vector<double> turning = turnings(outline);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const double angle = std::abs(turning[i]);
        if (angle < least_turning || turning[i] * turning[before] >= 0 || turning[i] * turning[after] >= 0) continue;
        const Point a = outline[(before + n - 1) % n], b = outline[before], c = outline[after],
                    d = outline[(after + 1) % n];
        const double without =
            std::max(std::abs(core::angle_between(b - a, c - b)), std::abs(core::angle_between(c - b, d - c)));
        if (without < share_without * angle) misplaced.push_back(i);
    }
    return misplaced;
}

}  // namespace lamina::surface
