#include "surface/corners.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"

namespace lamina::surface {

namespace {

/// No vertex that turns by less is a corner.
constexpr double min_corner_turning = core::radians(10);
/// A vertex that turns by more is a corner even if only one of its neighbours is straight.
constexpr double min_one_sided_turning = core::radians(35);
/// A vertex that turns by more is a corner, since nothing tells how round the body is between the samples.
constexpr double min_certain_turning = core::radians(125);
/// A neighbour is straight where it turns by less than this share of the vertex's turning.
constexpr double max_straight_share = 0.2;

/// Vertices in a row are the corners of a polygon where each turns to the same side by more than this ...
constexpr double min_polygon_turning = core::radians(40);
/// ... and all together turn by more than any nose does.
constexpr double max_nose_turning = core::radians(240);

/// A vertex between two sides longer than this share of the outline is a corner where it turns by more than the angle:
/// samples of a smooth curve do not stand so far apart.
constexpr double long_side_share = 0.35;
constexpr double min_turning_of_long_sides = core::radians(1);

/// Returns, for each vertex, whether it is a corner of a polygon.
std::vector<bool> find_polygon_corners(std::span<const double> turning) {
    const std::size_t n = turning.size();
    std::vector<bool> is_corner(n, false);
    const auto are_joined = [&](std::size_t i, std::size_t j) {
        return std::min(std::abs(turning[i]), std::abs(turning[j])) > min_polygon_turning &&
               turning[i] * turning[j] > 0;
    };
    for (std::size_t i = 0; i < n; ++i) {
        double sum = std::abs(turning[i]);
        for (std::size_t j = i; j - i < n && are_joined(j % n, (j + 1) % n); ++j) sum += std::abs(turning[(j + 1) % n]);
        for (std::size_t j = i + n; i + n - j < n && are_joined(j % n, (j - 1) % n); --j)
            sum += std::abs(turning[(j - 1) % n]);
        is_corner[i] = std::abs(turning[i]) > min_polygon_turning && sum > max_nose_turning;
    }
    return is_corner;
}

}  // namespace

std::vector<double> turning_angles(std::span<const Point> outline) {
    const std::size_t n = outline.size();
    std::vector<double> result(n);
    for (std::size_t i = 0; i < n; ++i)
        result[i] = core::angle_between(outline[i] - outline[(i + n - 1) % n], outline[(i + 1) % n] - outline[i]);
    return result;
}

std::vector<std::size_t> find_corners(std::span<const Point> outline) {
    const std::vector<double> turning = turning_angles(outline);
    const std::vector<bool> is_polygon_corner = find_polygon_corners(turning);
    const std::size_t n = outline.size();
    // Tells whether the neighbour j of i hardly turns to the same side. A neighbour that is a certain corner counts as
    // straight, since it bends no curve.
    const auto is_straight = [&](std::size_t i, std::size_t j) {
        const double angle = std::abs(turning[i]), same_side = turning[i] > 0 ? turning[j] : -turning[j];
        return same_side > min_certain_turning || same_side < max_straight_share * std::min(angle, core::pi - angle);
    };
    const double long_side = long_side_share * core::longer_side(core::bounding_box(outline));
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = std::abs(turning[i]);
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const bool between_long_sides =
            distance(outline[before], outline[i]) > long_side && distance(outline[i], outline[after]) > long_side;
        if (between_long_sides && angle > min_turning_of_long_sides) {
            corners.push_back(i);
            continue;
        }
        if (angle < min_corner_turning) continue;
        const bool straight_before = is_straight(i, before), straight_after = is_straight(i, after);
        // Two neighbouring vertices may share a nose. The outline is then round beyond the other vertex, which it is
        // not at a base.
        const std::size_t partner = straight_before ? after : before;
        const std::size_t beyond_partner = straight_before ? (i + 2) % n : (i + n - 2) % n;
        const bool shares_nose =
            std::abs(turning[partner]) > min_one_sided_turning && !is_straight(partner, beyond_partner);
        const bool one_sided = straight_before != straight_after && angle > min_one_sided_turning && !shares_nose;
        if ((straight_before && straight_after) || one_sided || angle > min_certain_turning || is_polygon_corner[i])
            corners.push_back(i);
    }
    return corners;
}

}  // namespace lamina::surface
