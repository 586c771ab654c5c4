#include "surface/corners.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "core/tight_box.hpp"

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

/// Vertices in a row are the corners of a polygon where each turns by more than this, to the same side or between sides
/// of about the same length ...
constexpr double min_polygon_turning = core::radians(40);
constexpr double max_ratio_of_equal_sides = 1.25;
/// ... and all together turn by more than any nose does.
constexpr double max_nose_turning = core::radians(240);

/// A vertex between two sides longer than this share of the outline is a corner where it turns by more than the angle:
/// samples of a smooth curve do not stand so far apart.
constexpr double long_side_share = 0.35;
constexpr double min_turning_of_long_sides = core::radians(1);

/// A nose grows like a parabola: its thickness is the distance from the vertex to a power between these.
constexpr double min_nose_power = 0.35, max_nose_power = 0.75;
/// Beside the foremost sample of a nose the outline turns on, by an angle between these.
constexpr double min_turning_beside_nose = core::radians(5), max_turning_beside_nose = core::radians(55);
/// The first and the last vertex of a file are a trailing edge if they end the chord, but for this share of it, and
/// turn by more than the angle.
constexpr double end_share = 1e-3;
constexpr double min_turning_of_ends = core::radians(60);

/// Returns whether the outline grows like a round nose from a vertex: of what is between its neighbours, and between
/// the next ones, the thickness across the axis of the nose grows about as the square root of the distance along it.
bool is_round_nose(std::span<const Point> outline, std::size_t vertex) {
    const std::size_t n = outline.size();
    if (n < 6) return false;
    const Point tip = outline[vertex];
    const Point a1 = outline[(vertex + n - 1) % n], b1 = outline[(vertex + 1) % n];
    const Point a2 = outline[(vertex + n - 2) % n], b2 = outline[(vertex + 2) % n];
    const Point axis = midpoint(a1, b1) - tip;
    const double along1 = dot(axis, axis), along2 = dot(axis, midpoint(a2, b2) - tip);
    const double across1 = cross(axis, a1 - b1), across2 = cross(axis, a2 - b2);
    if (!(along1 > 0 && along2 > along1 && across1 * across2 > 0)) return false;
    const double growth = across2 / across1, ratio = along2 / along1;
    return growth > core::pow_reproducible(ratio, min_nose_power) &&
           growth < core::pow_reproducible(ratio, max_nose_power);
}

/// Returns whether a vertex is one of the ends of a file, and an end of the chord: of the longest distance in the
/// outline, but for end_share of it.
bool is_chord_end(std::span<const Point> outline, std::size_t vertex) {
    if (vertex != 0 && vertex + 1 != outline.size()) return false;
    const Point tip = outline[vertex], other = outline[geometry::farthest_vertex(outline, tip)];
    return distance(other, outline[geometry::farthest_vertex(outline, other)]) <=
           (1 + end_share) * distance(other, tip);
}

/// Returns, for each vertex, whether it is a corner of a polygon.
std::vector<bool> find_polygon_corners(std::span<const Point> outline, std::span<const double> turning) {
    const std::size_t n = turning.size();
    std::vector<bool> is_corner(n, false);
    const auto side = [&](std::size_t i) { return distance(outline[i % n], outline[(i + 1) % n]); };
    const auto are_equal = [](double a, double b) {
        return std::max(a, b) <= max_ratio_of_equal_sides * std::min(a, b);
    };
    const auto is_joined_to_next = [&](std::size_t i) {
        if (std::min(std::abs(turning[i]), std::abs(turning[(i + 1) % n])) <= min_polygon_turning) return false;
        return turning[i] * turning[(i + 1) % n] > 0 ||
               (are_equal(side(i), side(i + 1)) && are_equal(side(i), side(i + n - 1)));
    };
    for (std::size_t i = 0; i < n; ++i) {
        double sum = std::abs(turning[i]);
        for (std::size_t j = i; j - i < n && is_joined_to_next(j % n); ++j) sum += std::abs(turning[(j + 1) % n]);
        for (std::size_t j = i + n; i + n - j < n && is_joined_to_next((j - 1) % n); --j)
            sum += std::abs(turning[(j - 1) % n]);
        is_corner[i] = std::abs(turning[i]) > min_polygon_turning && sum > max_nose_turning;
    }
    return is_corner;
}

/// Tells corners from samples of smooth curves.
class CornerFinder {
public:
    explicit CornerFinder(std::span<const Point> outline)
        : outline_(outline),
          turning_(turning_angles(outline)),
          is_polygon_corner_(find_polygon_corners(outline, turning_)),
          long_side_(long_side_share * core::longer_side_of_tight_box(outline)) {}

    bool is_corner(std::size_t i) const {
        const double angle = std::abs(turning_[i]);
        if (angle > min_turning_of_long_sides && is_between_long_sides(i)) return true;
        if (angle < min_corner_turning) return false;
        if (is_polygon_corner_[i]) return true;
        const bool is_sharp =
            is_certain(i) || is_one_sided(i) || (is_straight(i, before(i)) && is_straight(i, after(i)));
        if (is_chord_end(outline_, i)) return is_sharp || (angle > min_turning_of_ends && !is_nose(i));
        return is_sharp && !is_nose(i);
    }

private:
    std::size_t before(std::size_t i) const { return (i + outline_.size() - 1) % outline_.size(); }
    std::size_t after(std::size_t i) const { return (i + 1) % outline_.size(); }
    /// Returns by how much the outline turns at j to the same side as at i.
    double turning_as(std::size_t i, std::size_t j) const { return turning_[i] > 0 ? turning_[j] : -turning_[j]; }
    bool is_certain(std::size_t i) const { return std::abs(turning_[i]) > min_certain_turning; }

    /// Returns whether the neighbour j of i hardly turns to the same side. A neighbour that is a certain corner counts
    /// as straight, since it bends no curve.
    bool is_straight(std::size_t i, std::size_t j) const {
        const double angle = std::abs(turning_[i]), same_side = turning_as(i, j);
        return same_side > min_certain_turning || same_side < max_straight_share * std::min(angle, core::pi - angle);
    }

    bool is_between_long_sides(std::size_t i) const {
        return distance(outline_[before(i)], outline_[i]) > long_side_ &&
               distance(outline_[i], outline_[after(i)]) > long_side_;
    }

    /// Returns whether the vertex is the foremost sample of a round nose.
    bool is_nose(std::size_t i) const {
        const auto turns_on = [&](std::size_t j) {
            return turning_as(i, j) > min_turning_beside_nose && turning_as(i, j) < max_turning_beside_nose;
        };
        return turns_on(before(i)) && turns_on(after(i)) && is_round_nose(outline_, i);
    }

    /// Returns whether one neighbour is straight and the other one not, and the two do not share a nose: the outline is
    /// then round beyond the other vertex, which it is not at a base.
    bool is_one_sided(std::size_t i) const {
        const bool straight_before = is_straight(i, before(i)), straight_after = is_straight(i, after(i));
        if (straight_before == straight_after || std::abs(turning_[i]) < min_one_sided_turning) return false;
        const std::size_t partner = straight_before ? after(i) : before(i);
        const std::size_t beyond = straight_before ? after(partner) : before(partner);
        const bool shares_nose =
            std::abs(turning_[partner]) > min_one_sided_turning && (!is_straight(partner, beyond) || is_nose(partner));
        return !shares_nose;
    }

    std::span<const Point> outline_;
    std::vector<double> turning_;
    std::vector<bool> is_polygon_corner_;
    double long_side_;
};

}  // namespace

std::vector<std::size_t> find_corners(std::span<const Point> outline) {
    const CornerFinder finder(outline);
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (finder.is_corner(i)) corners.push_back(i);
    return corners;
}

bool is_given_corner(const Element& element, std::size_t point) {
    return std::binary_search(element.given_corners.begin(), element.given_corners.end(), point);
}

std::vector<std::size_t> find_corners(const Element& element) {
    const std::vector<std::size_t> found = find_corners(element.points), &given = element.given_corners;
    std::vector<std::size_t> corners;
    std::set_union(found.begin(), found.end(), given.begin(), given.end(), std::back_inserter(corners));
    return corners;
}

}  // namespace lamina::surface
