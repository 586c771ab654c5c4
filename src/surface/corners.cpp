#include "surface/corners.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace lamina::surface {

namespace {

constexpr double least_kink = core::radians(10);  ///< below, no vertex is a corner
constexpr double one_sided = core::radians(35);   ///< above, one straight neighbour is enough
constexpr double always = core::radians(125);     ///< above, what is round between the samples cannot be told
constexpr double share_of_smooth_neighbour = 0.2;

/// Vertices in a row that turn to one side by more than `polygonal` each, and together by more than any nose does, are
/// the corners of a polygon.
constexpr double polygonal = core::radians(40);
constexpr double most_of_a_nose = core::radians(240);

std::vector<bool> polygon_corners(std::span<const double> turning) {
    const std::size_t n = turning.size();
    std::vector<bool> corner(n, false);
    const auto joined = [&](std::size_t i, std::size_t j) {
        return std::min(std::abs(turning[i]), std::abs(turning[j])) > polygonal && turning[i] * turning[j] > 0;
    };
    for (std::size_t i = 0; i < n; ++i) {
        double sum = std::abs(turning[i]);
        for (std::size_t j = i; j - i < n && joined(j % n, (j + 1) % n); ++j) sum += std::abs(turning[(j + 1) % n]);
        for (std::size_t j = i + n; i + n - j < n && joined(j % n, (j - 1) % n); --j)
            sum += std::abs(turning[(j - 1) % n]);
        corner[i] = std::abs(turning[i]) > polygonal && sum > most_of_a_nose;
    }
    return corner;
}

}  // namespace

std::vector<double> turnings(std::span<const Point> outline) {
    const std::size_t n = outline.size();
    std::vector<double> result(n);
    for (std::size_t i = 0; i < n; ++i)
        result[i] = core::angle_between(outline[i] - outline[(i + n - 1) % n], outline[(i + 1) % n] - outline[i]);
    return result;
}

std::vector<std::size_t> find_corners(std::span<const Point> outline) {
    const std::vector<double> turning = turnings(outline);
    const std::vector<bool> of_polygon = polygon_corners(turning);
    const std::size_t n = outline.size();
    // Whether the neighbour j of i hardly turns to the same side. One that is a corner by itself bends no curve.
    const auto is_straight = [&](std::size_t i, std::size_t j) {
        const double angle = std::abs(turning[i]), same_side = turning[i] > 0 ? turning[j] : -turning[j];
        return same_side > always || same_side < share_of_smooth_neighbour * std::min(angle, core::pi - angle);
    };
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = std::abs(turning[i]);
        if (angle < least_kink) continue;
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const bool straight_before = is_straight(i, before), straight_after = is_straight(i, after);
        // Two vertices may share a nose: then the way on from the other one is round, which it is not at a base.
        const std::size_t partner = straight_before ? after : before;
        const std::size_t beyond = straight_before ? (i + 2) % n : (i + n - 2) % n;
        const bool shares_nose = std::abs(turning[partner]) > one_sided && !is_straight(partner, beyond);
        const bool one_side = straight_before != straight_after && angle > one_sided && !shares_nose;
        if ((straight_before && straight_after) || one_side || angle > always || of_polygon[i]) corners.push_back(i);
    }
    return corners;
}

}  // namespace lamina::surface
