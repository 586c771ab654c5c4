#include "geometry/noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/reproducible_math.hpp"
#include "geometry/corners.hpp"

namespace lamina {

Noise find_noise(std::span<const Point> outline, std::span<const std::size_t> corners) {
    constexpr double least_turning = radians(0.2);
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

}  // namespace lamina
