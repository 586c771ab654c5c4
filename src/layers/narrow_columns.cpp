// Columns beside corners are often narrower than their last layers are high. Where the number of layers changes there,
// the rows above are shifted by up to a layer from one ray to the next, and the cells are sheared:
//
//     |   |              |   |
//     |   |__            |___|         Left: five layers beside four that end at the same height. Right: four, a little
//     |  /|  |           |   |         higher, on both rays. The number changes where columns are wide.
//     |_/ |__|           |___|
//     |  /|  |           |   |
//     |_/_|__|           |___|
//
// Each ray has a range of numbers with which a stretch can keep the front where it is. Among all sequences of numbers in
// these ranges, the cheapest is taken. A change costs the fourth power of the tangent by which the rows that it shifts
// are off a right angle with the rays. So a change costs little where columns are wide, and where rays lean, it costs
// less in one direction than in the other (docs/decisions/0057):
//
//         / / / /             / / / /
//        /_/ / /             /_/_/ /      rays that lean to the right; rows that fall in this direction, and that rise
//       / /_/ /             / / /_/
//      / / / /_            / / / /
//
#include "layers/narrow_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "layers/neighbours.hpp"

namespace lamina::layers {

namespace {

/// A column is narrow where its front is shorter than this share of the last layer's height. Elsewhere numbers stay as
/// the front asks, since the more layers are stretched, the more the last ones differ in height from the cells beyond.
constexpr double narrow_share = 0.8;
/// The same where something cuts layers short. There it counts as shorter where rays lean.
constexpr double narrow_share_of_cut = 1.5;
/// A change costs this much at least, so that there are few of them.
constexpr double least_cost = 0.05;
/// The tangent counts as this much at most, so that sums of costs are exact enough for small ones.
constexpr double most_tangent = 8;
/// Changes by several layers at a time are undone later (limit_count_differences()); they cost this many times as much.
constexpr double several_at_once = 100;
/// A number costs this much times the square of its distance from the one that is wanted.
constexpr double cost_of_distance = 0.01;
/// It costs this much for each layer. So of two sequences that cost the same otherwise, as in mirrored input, the one
/// with fewer layers is taken.
constexpr double cost_of_layer = 1e-6;

/// What a ray may have, and what changes cost on the column before it.
struct RayChoices {
    LayerRange range;
    std::uint32_t wanted;
    double increase = 0, decrease = 0;
};

/// The cheapest way to a number of layers.
struct Way {
    double cost;
    std::uint32_t before;  ///< the number on the ray before
};

Way cheapest_way(std::uint32_t n, const RayChoices& ray, const LayerRange& range_before,
                 std::span<const Way> ways_before) {
    const double off = double(n) - double(ray.wanted);
    const double own = cost_of_distance * off * off + cost_of_layer * n;
    Way best{HUGE_VAL, 0};
    for (const std::uint32_t m : {n, n - std::min(n, 1u), n + 1}) {
        const std::uint32_t before = std::clamp(m, range_before.least, range_before.most);
        const double change = double(n) - double(before);
        const double several = std::abs(change) > 1 ? several_at_once : 1;
        const double step = (change > 0 ? ray.increase : ray.decrease) * change * change * several;
        const double cost = ways_before[before - range_before.least].cost + step + own;
        if (cost < best.cost) best = {cost, before};
    }
    return best;
}

/// Returns the cheapest sequence of numbers on rays, of which the first and the last have one choice.
std::vector<std::uint32_t> cheapest_numbers(std::span<const RayChoices> rays) {
    std::vector<std::vector<Way>> ways{{{0, 0}}};
    for (std::size_t k = 1; k < rays.size(); ++k) {
        std::vector<Way>& here = ways.emplace_back();
        for (std::uint32_t n = rays[k].range.least; n <= rays[k].range.most; ++n)
            here.push_back(cheapest_way(n, rays[k], rays[k - 1].range, ways[k - 1]));
    }
    std::vector<std::uint32_t> numbers(rays.size());
    numbers.back() = rays.back().wanted;
    for (std::size_t k = rays.size() - 1; k > 0; --k) numbers[k - 1] = ways[k][numbers[k] - rays[k].range.least].before;
    return numbers;
}

/// Returns what it costs that the topmost row that two neighbouring rays share is one layer below the front on one of
/// them: `below[0]` of the first, or `below[1]` of the second.
double cost_of_change(const std::array<const RayLine*, 2>& rays, const std::array<double, 2>& heights,
                      const std::array<double, 2>& below) {
    const auto end = [&](std::size_t k) { return rays[k]->origin + (heights[k] - below[k]) * rays[k]->direction; };
    const Point row = end(1) - end(0), along = rays[0]->direction + rays[1]->direction;
    const double across = std::abs(cross(row, along)), shift = std::abs(dot(row, along));
    const double tangent = shift < most_tangent * across ? shift / across : most_tangent;
    const double square = tangent * tangent;
    return std::max(square * square, least_cost);
}

}  // namespace

void keep_counts_on_narrow_columns(const RaySet& set, std::span<const ColumnEnd> ends,
                                   std::vector<std::uint32_t>& counts) {
    const RayNeighbours rays(set);
    const auto is_narrow = [&](std::size_t i, std::size_t j, bool cut) {
        const RayLine &a = set.lines[i], &b = set.lines[j];
        const double height = std::min(ends[i].height, ends[j].height);
        const double width = length(b.origin - a.origin + height * (b.direction - a.direction));
        const double spacing = std::max(ends[i].last_spacing, ends[j].last_spacing);
        const double seen = cut ? max_row_slope(std::abs(tangent_of_lean(a, b))) : 1;
        return seen * width < (cut ? narrow_share_of_cut : narrow_share) * spacing;
    };
    // Rows of one ray that has a layer more than both of its neighbours would turn twice as much as at a change.
    const auto is_alone = [&](std::size_t i) {
        const std::uint32_t beside = counts[rays.next[i]];
        return counts[i] != beside && counts[rays.previous[i]] == beside;
    };
    const auto is_free = [&](std::size_t i) {
        return is_alone(i) || is_narrow(rays.previous[i], i, ends[i].cut) || is_narrow(i, rays.next[i], ends[i].cut);
    };
    const auto cost_between = [&](std::size_t i, std::size_t j, double below_i, double below_j) {
        return cost_of_change({&set.lines[i], &set.lines[j]}, {ends[i].height, ends[j].height}, {below_i, below_j});
    };
    for (std::size_t e = 0; e < set.elements(); ++e) {
        std::size_t first = set.begin[e];
        while (first + 1 < set.begin[e + 1] && is_free(first)) ++first;
        std::vector<RayChoices> choices{{{counts[first], counts[first]}, counts[first]}};
        for (std::size_t i = first; choices.size() == 1 || i != first;) {
            const std::size_t before = i;
            i = rays.next[i];
            const bool held = i == first || !is_free(i);
            choices.push_back({held ? LayerRange{counts[i], counts[i]} : ends[i].layers, counts[i],
                               cost_between(before, i, 0, ends[i].last_spacing),
                               cost_between(before, i, ends[before].last_spacing, 0)});
        }
        const std::vector<std::uint32_t> numbers = cheapest_numbers(choices);
        std::size_t i = first;
        for (std::size_t k = 0; k + 1 < numbers.size(); ++k, i = rays.next[i]) counts[i] = numbers[k];
    }
}

}  // namespace lamina::layers
