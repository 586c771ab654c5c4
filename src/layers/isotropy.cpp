// The distance between rays decides where a layer is as high as wide. It is measured where the layer lies, as rays
// spread round convex walls:
//
//      \   s(H)  |  s(H)  /
//       o--------o-------o        the layer at height H
//        \       |      /
//         o------o-----o          the wall
//            s(0)   s(0)
//
// Rays of a fan have no distance at the wall; they lead over from the one side of the corner to the other. Then what
// was found ray by ray is smoothed along the wall, lest the outer border become a saw.
#include "layers/isotropy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "layers/rays.hpp"

namespace lamina::layers {
namespace {

/// A layer hands over to isotropic triangles where it is this many times as high as wide (docs/decisions/0010).
constexpr double hand_over = 1;
/// Where rays spread, their distance counts up to this many times that at the wall: with slow growth, layers between
/// spreading rays never become as high as wide.
constexpr double largest_spread = 2;
/// Rise of the layers' border per unit of distance along it.
constexpr double steepest_border = 0.3;
/// Ratio of the last spacings, hence more than that of the heights, of neighbouring rays.
constexpr double neighbour_ratio = 1.25;

class Spacing {
public:
    explicit Spacing(const RaySet& set) : set_(set), next_(set.lines.size()), previous_(set.lines.size()) {
        for (std::size_t e = 0; e < set.elements(); ++e) {
            for (std::size_t i = set.begin[e], last = set.begin[e + 1] - 1; i < set.begin[e + 1]; last = i++) {
                next_[last] = i;
                previous_[i] = last;
            }
        }
    }

    std::size_t next(std::size_t ray) const { return next_[ray]; }
    std::size_t previous(std::size_t ray) const { return previous_[ray]; }
    /// True if the two are rays of one fan.
    bool same_origin(std::size_t a, std::size_t b) const { return set_.lines[a].origin == set_.lines[b].origin; }
    bool inside_fan(std::size_t ray) const { return same_origin(previous_[ray], ray) && same_origin(ray, next_[ray]); }

    /// Distance from the neighbours' points at this height: the geometric mean of both sides, but for the side of a
    /// fan.
    double at(std::size_t ray, double height) const {
        const bool left = !same_origin(previous_[ray], ray), right = !same_origin(ray, next_[ray]);
        const double before = left ? between(previous_[ray], ray, height) : 0;
        const double after = right ? between(ray, next_[ray], height) : 0;
        return left && right ? std::sqrt(before * after) : before + after;
    }

    /// Distance of the points of two rays at this height.
    double tips(std::size_t a, std::size_t b, double height) const {
        const RayLine &left = set_.lines[a], &right = set_.lines[b];
        return length(right.origin - left.origin + height * (right.direction - left.direction));
    }

private:
    const RaySet& set_;
    std::vector<std::size_t> next_, previous_;

    /// Zero beyond the point where the two rays cross.
    double between(std::size_t a, std::size_t b, double height) const {
        const RayLine &left = set_.lines[a], &right = set_.lines[b];
        const Point at_wall = right.origin - left.origin;
        const Point there = at_wall + height * (right.direction - left.direction);
        if (dot(there, at_wall) <= 0) return 0;
        return std::min(length(there), largest_spread * length(at_wall));
    }
};

/// Gives the rays inside each fan values between those of its first and last ray.
void fill_fans(const RaySet& set, const Spacing& spacing, std::vector<double>& values) {
    for (std::size_t i = 0; i < set.lines.size(); ++i) {
        if (spacing.same_origin(spacing.previous(i), i) || !spacing.same_origin(i, spacing.next(i))) continue;
        std::vector<std::size_t> fan{i};
        while (spacing.same_origin(i, spacing.next(fan.back()))) fan.push_back(spacing.next(fan.back()));
        const std::size_t steps = fan.size() - 1;
        const double first = values[fan.front()], last = values[fan.back()];
        const auto [least, most] = std::minmax(first, last);
        for (std::size_t k = 1; k < steps; ++k) {
            const double share = static_cast<double>(k), rest = static_cast<double>(steps - k);
            // Rounding must not lead out of the range that values may lie in.
            values[fan[k]] = std::clamp((first * rest + last * share) / static_cast<double>(steps), least, most);
        }
    }
}

/// Replaces each value by the median of those of the five rays round it.
void take_medians(const Spacing& spacing, std::vector<double>& values) {
    const std::vector<double> before = values;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t p = spacing.previous(i), n = spacing.next(i);
        double five[] = {before[spacing.previous(p)], before[p], before[i], before[n], before[spacing.next(n)]};
        std::nth_element(five, five + 2, five + 5);
        values[i] = five[2];
    }
}

/// Height at which a layer would be as high as wide, between the last one that is lower and the first that is not; that
/// of the last of all where none is.
double isotropic_height(const Spacing& spacing, std::size_t ray, std::span<const double> heights) {
    double lacking = 0;  // of the layer below
    for (std::size_t n = 1; n < heights.size(); ++n) {
        const double step = heights[n] - heights[n - 1];
        const double lacks = hand_over * spacing.at(ray, heights[n]) - step;
        if (lacks <= 0) return n == 1 ? heights[1] : heights[n - 1] + step * (lacking / (lacking - lacks));
        lacking = lacks;
    }
    return heights.back();
}

/// base^exponent, by squaring.
double whole_power(double base, std::uint32_t exponent) {
    double power = 1;
    for (; exponent > 0; exponent >>= 1, base *= base)
        if (exponent & 1) power *= base;
    return power;
}

/// The largest of the doubles found by halving [low, high] a fixed number of times for which `below` holds.
template <class Below>
double bisect(double low, double high, Below below) {
    if (below(high)) return high;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        (below(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace

std::vector<std::uint32_t> layers_up_to_isotropy(const RaySet& set, std::span<const double> heights) {
    const Spacing spacing(set);
    std::vector<double> reached(set.lines.size());
    for (std::size_t i = 0; i < reached.size(); ++i)
        if (!spacing.inside_fan(i)) reached[i] = isotropic_height(spacing, i, heights);
    fill_fans(set, spacing, reached);
    for (int round = 0; round < 2; ++round) take_medians(spacing, reached);
    lower_to_neighbours(set, reached, [&](std::size_t from, std::size_t to) {
        return reached[from] + steepest_border * spacing.tips(from, to, reached[from]);
    });
    std::vector<std::uint32_t> layers(set.lines.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const auto above = std::upper_bound(heights.begin(), heights.end(), reached[i]);
        layers[i] = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(above - heights.begin()) - 1);
    }
    limit_steps(set, layers);
    return layers;
}

std::vector<double> ratios_to_isotropy(const RaySet& set, double first_height, std::uint32_t layers) {
    if (layers < 2) return std::vector<double>(set.lines.size(), min_adaptive_ratio);
    const Spacing spacing(set);
    std::vector<double> ratios(set.lines.size());
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        if (spacing.inside_fan(i)) continue;
        ratios[i] = bisect(min_adaptive_ratio, max_adaptive_ratio, [&](double ratio) {
            const double last = first_height * whole_power(ratio, layers - 1);
            const double height = (last * ratio - first_height) / (ratio - 1);
            return last <= hand_over * spacing.at(i, height);
        });
    }
    fill_fans(set, spacing, ratios);
    // With spacings s = h r^(N - 1) of the last layers in the ratio q, heights (r s - h) / (r - 1) are in less than q.
    const double most =
        bisect(1, neighbour_ratio, [&](double ratio) { return whole_power(ratio, layers - 1) <= neighbour_ratio; });
    lower_to_neighbours(set, ratios, [&](std::size_t from, std::size_t) { return most * ratios[from]; });
    return ratios;
}

}  // namespace lamina::layers
