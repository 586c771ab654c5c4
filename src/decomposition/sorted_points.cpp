// Radix sort: a coordinate is mapped to 24 bits, ascending, and points are dealt by 12 of them at a time, the lower
// ones first; block by block on all threads. What the bits leave undecided is sorted by the coordinates themselves, so
// no spread of the points costs more than a comparison sort.
#include "decomposition/sorted_points.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <lamina/predicates.hpp>

#include "core/parallel.hpp"

namespace lamina::decomposition {

namespace {

constexpr unsigned digit_bits = 12;
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;
constexpr std::uint32_t key_values = 1u << 2 * digit_bits;
constexpr std::size_t block = std::size_t{1} << 17;

/// The key above, the point's number below.
using Item = std::uint64_t;
constexpr Index number_of(Item item) { return static_cast<Index>(item); }
constexpr std::uint32_t key_of(Item item) { return static_cast<std::uint32_t>(item >> 32); }
constexpr std::size_t digit_of(Item item, unsigned digit) {
    return item >> (32 + digit * digit_bits) & (digit_values - 1);
}

/// How often each value of a digit stands in a block; then where the next item of that value goes.
using Places = std::array<std::uint32_t, digit_values>;

/// One pass, stable: items with equal digits keep their order. `counts` are those of the blocks.
void deal_by_digit(const UninitializedArray<Item>& items, UninitializedArray<Item>& dealt, unsigned digit,
                   std::vector<Places> counts) {
    std::uint32_t sum = 0;
    for (std::size_t v = 0; v < digit_values; ++v)
        for (Places& p : counts) sum += std::exchange(p[v], sum);
    parallel_for(items.size(), block, [&](std::size_t begin, std::size_t end) {
        Places& at = counts[begin / block];
        for (std::size_t i = begin; i < end; ++i) dealt[at[digit_of(items[i], digit)]++] = items[i];
    });
}

struct Sorted {
    UninitializedArray<Index> order;
    bool distinct = true;  ///< no two in it are equal
};

/// Numbers 0 to n - 1 by their coordinate, which lies between low and high; `before` orders numbers whose coordinates
/// are the same.
template <class Coordinate, class Before>
Sorted order_by(std::size_t n, double low, double high, Coordinate&& coordinate, Before&& before) {
    const double scale = high > low ? (key_values - 1) / (high - low) : 0.0;
    UninitializedArray<Item> items(n), dealt(n);
    std::vector<Places> counts = parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) {
        Places count{};
        for (std::size_t i = begin; i < end; ++i) {
            items[i] = std::uint64_t{static_cast<std::uint32_t>((coordinate(i) - low) * scale)} << 32 | i;
            ++count[digit_of(items[i], 0)];
        }
        return count;
    });
    deal_by_digit(items, dealt, 0, std::move(counts));
    counts = parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) {
        Places count{};
        for (std::size_t i = begin; i < end; ++i) ++count[digit_of(dealt[i], 1)];
        return count;
    });
    deal_by_digit(dealt, items, 1, std::move(counts));

    Sorted sorted{UninitializedArray<Index>(n)};
    const auto less = [&](Index a, Index b) {
        const double at_a = coordinate(a), at_b = coordinate(b);
        return at_a != at_b ? at_a < at_b : before(a, b);
    };
    const auto same_key = [&](std::size_t i) { return key_of(items[i]) == key_of(items[i - 1]); };
    const std::vector<char> distinct = parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) -> char {
        // Runs of one key belong to the block they begin in.
        while (begin > 0 && begin < end && same_key(begin)) ++begin;
        while (begin < end && end < n && same_key(end)) ++end;
        Index* const order = sorted.order.data();
        bool all = true;
        for (std::size_t i = begin; i < end;) {
            const std::size_t first = i;
            do order[i] = number_of(items[i]);
            while (++i < end && same_key(i));
            if (i == first + 1) continue;
            if (i > first + 2)
                std::sort(order + first, order + i, less);
            else if (less(order[first + 1], order[first]))
                std::swap(order[first], order[first + 1]);
            for (std::size_t k = first + 1; k < i; ++k) all &= less(order[k - 1], order[k]);
        }
        return all;
    });
    sorted.distinct = std::find(distinct.begin(), distinct.end(), 0) == distinct.end();
    return sorted;
}

/// Nothing where a point lies outside the exact range.
std::optional<Box> checked_box(std::span<const Point> points) {
    struct Checked {
        Box box;
        bool in_range = true;
    };
    Checked whole;
    for (const Checked& part : parallel_blocks(points.size(), block, [&](std::size_t begin, std::size_t end) {
             Checked checked;
             for (const Point p : points.subspan(begin, end - begin)) {
                 checked.box.include(p);
                 checked.in_range &= in_exact_range(p);
             }
             return checked;
         })) {
        whole.box.include(part.box.lower);
        whole.box.include(part.box.upper);
        whole.in_range &= part.in_range;
    }
    if (!whole.in_range) return {};
    return whole.box;
}

}  // namespace

std::optional<SortedPoints> sort_points(std::span<const Point> points) {
    const std::size_t n = points.size();
    const std::optional<Box> box = checked_box(points);
    if (!box) return {};
    SortedPoints sorted;
    Sorted by_x = order_by(
        n, box->lower.x, box->upper.x, [&](std::size_t i) { return points[i].x; },
        [&](Index a, Index b) { return points[a].y < points[b].y; });
    if (!by_x.distinct) return {};
    sorted.original = std::move(by_x.order);
    sorted.points = UninitializedArray<Point>(n);
    parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sorted.points[i] = points[sorted.original[i]];
    });
    sorted.by_y = order_by(
                      n, box->lower.y, box->upper.y, [&](std::size_t i) { return sorted.points[i].y; },
                      [](Index a, Index b) { return a < b; })
                      .order;
    sorted.y_rank = UninitializedArray<Index>(n);
    parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sorted.y_rank[sorted.by_y[i]] = static_cast<Index>(i);
    });
    return sorted;
}

}  // namespace lamina::decomposition
