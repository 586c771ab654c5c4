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
// A change costs as much, too, where rows turn at one of its rays so that the middles of the cells on both sides lie far
// below the middle of the face between them (docs/decisions/0060):
//
//        __|__
//       /  |  \      rows that fall away from
//      /  _|_  \     a ray on both sides
//        / | \     .
//
#include "layers/narrow_columns.hpp"

#include <algorithm>
#include <cmath>

#include "layers/mechanisms.hpp"
#include "layers/neighbours.hpp"
#include "layers/rows.hpp"

namespace lamina::layers {

namespace {

/// A column is narrow where its front is shorter than this share of the last layer's height. Elsewhere numbers stay as
/// the front asks, since the more layers are stretched, the more the last ones differ in height from the cells beyond.
constexpr double narrow_share = 0.8;
/// The same where something cuts layers short. There it counts as shorter where rays lean.
constexpr double narrow_share_of_cut = 1.5;
/// A change costs this much at least, so that there are few of them.
constexpr double least_cost = 0.05;
/// A change of numbers that are wanted is moved, by up to so many columns, where it costs more than this: where a row
/// is off a right angle by 53 degrees, or a skewness is 1.3.
constexpr double most_wanted_cost = 3;
constexpr std::size_t columns_to_move = 4;
/// Changes by several layers at a time are undone later (limit_count_differences()); they cost this many times as much.
constexpr double several_at_once = 100;
/// A number costs this much times the square of its distance from the one that is wanted.
constexpr double cost_of_distance = 0.01;
/// It costs this much for each layer. So of two sequences that cost the same otherwise, as in mirrored input, the one
/// with fewer layers is taken.
constexpr double cost_of_layer = 1e-6;

/// On narrow columns more layers are wanted, down to last layers this many times as high as wide: the more there are,
/// the more gradually the last ones become as high as the triangles beyond (taper.cpp).
constexpr double tallness_of_narrow = 2;

/// What a ray may have.
struct RayChoices {
    LayerRange range;
    std::uint32_t wanted;
    const ColumnEnd* end;
    ColumnRow row;  ///< of the front, from the ray before to this one
};

/// Returns the height of the last of n layers, which are stretched to end at the front: between those of the number that
/// is wanted and of the least or the most.
double last_spacing(const ColumnEnd& end, std::uint32_t n) {
    const auto between = [&](std::uint32_t other, double spacing) {
        const double share = (double(n) - double(end.wanted)) / (double(other) - double(end.wanted));
        return end.last_spacing + std::min(share, 1.0) * (spacing - end.last_spacing);
    };
    if (n < end.wanted && end.layers.least < end.wanted) return between(end.layers.least, end.spacing_of_least);
    if (n > end.wanted && end.layers.most > end.wanted) return between(end.layers.most, end.spacing_of_most);
    return end.last_spacing;
}

/// Returns what it costs that the number of layers changes from `before` to `n` on the column before ray k. The topmost
/// row that both rays share is one layer below the front on one of them. At both rays it meets rows of the front, which
/// makes faces skewed; a skewness costs as much as a tangent of that size.
double cost_of_change(std::span<const RayChoices> rays, std::size_t k, std::uint32_t before, std::uint32_t n) {
    const RayChoices &ray = rays[k], &ray_before = rays[k - 1], &ray_after = rays[k + 1 < rays.size() ? k + 1 : 1];
    const double spacing = last_spacing(*ray.end, n), spacing_before = last_spacing(*ray_before.end, before);
    ColumnRow row = ray.row;
    row.rise += n > before ? -spacing : spacing_before;
    const double skewness =
        std::max(skewness_between(ray_before.row, row, spacing_before), skewness_between(row, ray_after.row, spacing));
    const double tangent = std::max(tangent_of(row), skewness), square = tangent * tangent;
    return std::max(square * square, least_cost);
}

/// The cheapest way to a number of layers.
struct Way {
    double cost;
    std::uint32_t before;  ///< the number on the ray before
};

Way cheapest_way(std::span<const RayChoices> rays, std::size_t k, std::uint32_t n, std::span<const Way> ways_before) {
    const LayerRange& range_before = rays[k - 1].range;
    const double off = double(n) - double(rays[k].wanted);
    const double own = cost_of_distance * off * off + cost_of_layer * n;
    Way best{HUGE_VAL, 0};
    for (const std::uint32_t m : {n, n - std::min(n, 1u), n + 1}) {
        const std::uint32_t before = std::clamp(m, range_before.least, range_before.most);
        const double change = std::abs(double(n) - double(before));
        const double several = change > 1 ? several_at_once : 1;
        const double step = change > 0 ? cost_of_change(rays, k, before, n) * change * change * several : 0;
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
            here.push_back(cheapest_way(rays, k, n, ways[k - 1]));
    }
    std::vector<std::uint32_t> numbers(rays.size());
    numbers.back() = rays.back().wanted;
    for (std::size_t k = rays.size() - 1; k > 0; --k) numbers[k - 1] = ways[k][numbers[k] - rays[k].range.least].before;
    return numbers;
}

/// Returns the numbers that are wanted on the rays of an element, and at the end those of the first ray again.
std::vector<RayChoices> wanted_numbers(const RaySet& set, std::span<const ColumnEnd> ends,
                                       std::span<const std::uint32_t> counts, std::size_t element) {
    const std::size_t begin = set.begin[element], end = set.begin[element + 1];
    std::vector<RayChoices> choices;
    choices.reserve(end - begin + 1);
    for (std::size_t i = begin, before = end - 1; i < end; before = i++)
        choices.push_back({{counts[i], counts[i]},
                           counts[i],
                           &ends[i],
                           row_between(set.lines[before], ends[before].height, set.lines[i], ends[i].height)});
    choices.push_back(choices.front());
    return choices;
}

/// Returns whether the column between two rays of an element, of which one is cut short or not, is narrow.
bool is_narrow(const RayLine& a, const ColumnEnd& end_a, const RayLine& b, const ColumnEnd& end_b, bool cut) {
    const double height = std::min(end_a.height, end_b.height);
    const double width = length(b.origin - a.origin + height * (b.direction - a.direction));
    const double spacing = std::max(end_a.last_spacing, end_b.last_spacing);
    const double seen = cut ? max_row_slope(std::abs(tangent_of_lean(a, b))) : 1;
    return seen * width < (cut ? narrow_share_of_cut : narrow_share) * spacing;
}

/// Returns, for each ray of an element, whether its number may become another one than is wanted: beside narrow columns
/// and near changes that cost much. Rows of one ray that has a layer more than both of its neighbours would turn twice as
/// much as at a change, so its number is free, too.
std::vector<char> free_rays(std::span<const RayLine> lines, std::span<const RayChoices> choices) {
    const std::size_t n = lines.size();
    std::vector<char> free(n, 0);
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t before = (k + n - 1) % n, after = (k + 1) % n;
        const std::uint32_t own = choices[k].wanted, beside = choices[after].wanted;
        const auto is_narrow_up_to = [&](std::size_t other) {
            return is_narrow(lines[other], *choices[other].end, lines[k], *choices[k].end, choices[k].end->cut);
        };
        const bool is_alone = own != beside && choices[before].wanted == beside;
        if (is_alone || is_narrow_up_to(before) || is_narrow_up_to(after)) free[k] = 1;
    }
    for (std::size_t k = 1; k <= n; ++k) {
        const std::uint32_t before = choices[k - 1].wanted, wanted = choices[k].wanted;
        if (before == wanted || before == 0 || wanted == 0) continue;
        if (!(cost_of_change(choices, k, before, wanted) > most_wanted_cost)) continue;
        for (std::size_t step = 0; step < std::min(columns_to_move, n); ++step)
            free[(k + step) % n] = free[(k - 1 + n - step) % n] = 1;
    }
    return free;
}

/// Returns the number that is wanted on a ray beside narrow columns: the largest in its range with which the last layer
/// is still so many times as high as the columns are wide, if that is more than was wanted.
std::uint32_t number_on_narrow_column(const RayChoices& ray, double width) {
    std::uint32_t n = ray.wanted;
    while (n < ray.range.most && last_spacing(*ray.end, n + 1) >= tallness_of_narrow * width) ++n;
    return n;
}

}  // namespace

void keep_counts_on_narrow_columns(const RaySet& set, std::span<const ColumnEnd> ends,
                                   std::vector<std::uint32_t>& counts) {
    if (!uses("cheapest_counts")) return;
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t begin = set.begin[e], n = set.begin[e + 1] - begin;
        std::vector<RayChoices> choices = wanted_numbers(set, ends, counts, e);
        const std::vector<char> free = free_rays(std::span(set.lines).subspan(begin, n), choices);
        const auto held = std::find(free.begin(), free.end(), 0);
        // Where all are free, one must be held.
        const std::size_t first = held == free.end() ? n - 1 : static_cast<std::size_t>(held - free.begin());
        choices.pop_back();
        for (std::size_t k = 0; k < n; ++k) {
            if (!free[k] || k == first) continue;
            choices[k].range = choices[k].end->layers;
            const double width = std::sqrt(choices[k].row.width * choices[k + 1 < n ? k + 1 : 0].row.width);
            if (uses("more_on_narrow")) choices[k].wanted = number_on_narrow_column(choices[k], width);
        }
        std::rotate(choices.begin(), choices.begin() + static_cast<std::ptrdiff_t>(first), choices.end());
        choices.push_back(choices.front());
        const std::vector<std::uint32_t> numbers = cheapest_numbers(choices);
        for (std::size_t k = 0; k < n; ++k) counts[begin + (first + k) % n] = numbers[k];
    }
}

}  // namespace lamina::layers
