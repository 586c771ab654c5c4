// Radix sort: a coordinate is mapped to 32 bits, ascending, and points are dealt by 11 of them at a time, the lowest
// first; block by block on all threads. What the bits leave undecided is sorted by the coordinates themselves, so no
// spread of the points costs more than a comparison sort.
#include "decomposition/sorted_points.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <lamina/predicates.hpp>

#include "core/parallel.hpp"

namespace lamina::decomposition {

namespace {

constexpr unsigned digit_bits = 11;
constexpr unsigned digits = 3;  // of a key of 32 bits
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;
constexpr std::size_t block = std::size_t{1} << 17;

/// The key above, the point's number below.
using Item = std::uint64_t;
constexpr Index number_of(Item item) { return static_cast<Index>(item); }
constexpr std::uint32_t key_of(Item item) { return static_cast<std::uint32_t>(item >> 32); }

using Places = std::array<std::uint32_t, digit_values>;

/// One pass, stable: items with equal digits keep their order.
void deal_by_digit(const UninitializedArray<Item>& items, UninitializedArray<Item>& dealt, unsigned digit) {
    const auto value = [shift = 32 + digit * digit_bits](Item i) { return i >> shift & (digit_values - 1); };
    std::vector<Places> places = parallel_blocks(items.size(), block, [&](std::size_t begin, std::size_t end) {
        Places counts{};
        for (std::size_t i = begin; i < end; ++i) ++counts[value(items[i])];
        return counts;
    });
    std::uint32_t sum = 0;
    for (std::size_t v = 0; v < digit_values; ++v)
        for (Places& p : places) sum += std::exchange(p[v], sum);
    parallel_for(items.size(), block, [&](std::size_t begin, std::size_t end) {
        Places& at = places[begin / block];
        for (std::size_t i = begin; i < end; ++i) dealt[at[value(items[i])]++] = items[i];
    });
}

/// Numbers 0 to n - 1 by their coordinate, which lies between low and high; `before` orders numbers whose coordinates
/// are the same.
template <class Coordinate, class Before>
UninitializedArray<Index> order_by(std::size_t n, double low, double high, Coordinate&& coordinate, Before&& before) {
    const double scale = high > low ? 0x1.fffffep31 / (high - low) : 0.0;
    UninitializedArray<Item> items(n), dealt(n);
    parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            items[i] = std::uint64_t{static_cast<std::uint32_t>((coordinate(i) - low) * scale)} << 32 | i;
    });
    for (unsigned digit = 0; digit < digits; ++digit) {
        deal_by_digit(items, dealt, digit);
        std::swap(items, dealt);
    }

    UninitializedArray<Index> order(n);
    const auto less = [&](Index a, Index b) {
        const double at_a = coordinate(a), at_b = coordinate(b);
        return at_a != at_b ? at_a < at_b : before(a, b);
    };
    const auto same_key = [&](std::size_t i) { return key_of(items[i]) == key_of(items[i - 1]); };
    parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
        // Runs of one key belong to the block they begin in.
        while (begin > 0 && begin < end && same_key(begin)) ++begin;
        while (begin < end && end < n && same_key(end)) ++end;
        for (std::size_t i = begin; i < end; ++i) order[i] = number_of(items[i]);
        for (std::size_t i = begin + 1; i < end; ++i) {
            if (!same_key(i)) continue;
            const std::size_t first = i - 1;
            while (i < end && same_key(i)) ++i;
            std::sort(order.begin() + first, order.begin() + i, less);
        }
    });
    return order;
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
    sorted.original = order_by(
        n, box->lower.x, box->upper.x, [&](std::size_t i) { return points[i].x; },
        [&](Index a, Index b) { return points[a].y != points[b].y ? points[a].y < points[b].y : a < b; });
    sorted.points = UninitializedArray<Point>(n);
    const std::vector<char> distinct = parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) -> char {
        bool all = true;
        for (std::size_t i = begin; i < end; ++i) {
            sorted.points[i] = points[sorted.original[i]];
            all &= i == 0 || !(points[sorted.original[i - 1]] == sorted.points[i]);
        }
        return all;
    });
    if (std::find(distinct.begin(), distinct.end(), 0) != distinct.end()) return {};
    sorted.by_y = order_by(
        n, box->lower.y, box->upper.y, [&](std::size_t i) { return sorted.points[i].y; },
        [](Index a, Index b) { return a < b; });
    sorted.y_rank = UninitializedArray<Index>(n);
    parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sorted.y_rank[sorted.by_y[i]] = static_cast<Index>(i);
    });
    return sorted;
}

}  // namespace lamina::decomposition
