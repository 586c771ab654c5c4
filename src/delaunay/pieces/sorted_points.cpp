// Radix sort: a coordinate is mapped to 24 bits, ascending, and points are dealt by 12 of them at a time, the lower
// ones first; block by block on all threads. What the bits leave undecided is sorted by the coordinates themselves, so
// no spread of the points costs more than a comparison sort.
#include "delaunay/pieces/sorted_points.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <lamina/predicates.hpp>

#include "core/parallel.hpp"

namespace lamina::delaunay::pieces {

namespace {

constexpr unsigned digit_bits = 12;
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;
constexpr std::uint32_t key_values = 1u << 2 * digit_bits;

/// What is done block by block, on all threads.
class Blocks {
public:
    Blocks(std::size_t n, core::BusyTimes* times) : n_(n), times_(times) {}

    template <class F>
    void for_each(F&& f) const {
        core::parallel_for(n_, size, [&](std::size_t begin, std::size_t end) {
            const core::BusyTimes::Scope busy(times_, cutting);
            f(begin, end);
        });
    }
    template <class F>
    auto results(F&& f) const {
        return core::parallel_blocks(n_, size, [&](std::size_t begin, std::size_t end) {
            const core::BusyTimes::Scope busy(times_, cutting);
            return f(begin, end);
        });
    }
    static std::size_t number(std::size_t begin) { return begin / size; }

private:
    static constexpr std::size_t size = std::size_t{1} << 17;
    std::size_t n_;
    core::BusyTimes* times_;
};

/// The key above, the point's number below.
using Item = std::uint64_t;
constexpr Index number_of(Item item) { return static_cast<Index>(item); }
constexpr std::uint32_t key_of(Item item) { return static_cast<std::uint32_t>(item >> 32); }
template <unsigned digit>
constexpr std::size_t digit_of(Item item) {
    return item >> (32 + digit * digit_bits) & (digit_values - 1);
}

/// How often each value of a digit stands in a block; later where the next item of that value goes.
using Counts = std::array<std::uint32_t, digit_values>;

/// One pass, stable: items with equal digits keep their order. `counts` are those of the blocks.
template <unsigned digit>
void deal_by_digit(const Blocks& blocks, const core::UninitializedArray<Item>& items,
                   core::UninitializedArray<Item>& dealt, std::vector<Counts> counts) {
    std::uint32_t sum = 0;
    for (std::size_t v = 0; v < digit_values; ++v)
        for (Counts& p : counts) sum += std::exchange(p[v], sum);
    blocks.for_each([&](std::size_t begin, std::size_t end) {
        std::uint32_t* const at = counts[Blocks::number(begin)].data();
        const Item* const from = items.begin();
        Item* const to = dealt.data();
        for (std::size_t i = begin; i < end; ++i) to[at[digit_of<digit>(from[i])]++] = from[i];
    });
}

struct Sorted {
    core::UninitializedArray<Index> order;
    bool distinct = true;  ///< no two in it are equal
};

/// Copies the numbers of items sorted by their keys, and sorts those of one key. False where two of them are equal.
template <class Less>
bool sort_runs(const Item* items, std::size_t begin, std::size_t end, Index* order, Less&& less) {
    bool distinct = true;
    std::uint32_t previous = key_values;
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t key = key_of(items[i]);
        order[i] = number_of(items[i]);
        if (std::exchange(previous, key) != key) continue;
        Index* const first = order + i - 1;
        while (i + 1 < end && key_of(items[i + 1]) == key) {
            ++i;
            order[i] = number_of(items[i]);
        }
        Index* const last = order + i;
        // Most runs are pairs.
        if (last == first + 1 && less(*last, *first)) {
            std::swap(*first, *last);
            continue;
        }
        if (last > first + 1) std::sort(first, last + 1, less);
        for (const Index* k = first; k != last; ++k) distinct &= less(k[0], k[1]);
    }
    return distinct;
}

/// Numbers 0 to n - 1 by their coordinate, which lies between low and high; `before` orders numbers whose coordinates
/// are the same.
template <class Coordinate, class Before>
Sorted order_by(const Blocks& blocks, std::size_t n, double low, double high, Coordinate coordinate, Before before) {
    const double scale = high > low ? (key_values - 1) / (high - low) : 0.0;
    core::UninitializedArray<Item> items(n), dealt(n);
    std::vector<Counts> counts = blocks.results([&, low, coordinate](std::size_t begin, std::size_t end) {
        Counts count{};
        Item* const to = items.data();
        for (std::size_t i = begin; i < end; ++i) {
            to[i] = std::uint64_t{static_cast<std::uint32_t>((coordinate(i) - low) * scale)} << 32 | i;
            ++count[digit_of<0>(to[i])];
        }
        return count;
    });
    deal_by_digit<0>(blocks, items, dealt, std::move(counts));
    counts = blocks.results([from = dealt.data()](std::size_t begin, std::size_t end) {
        Counts count{};
        for (std::size_t i = begin; i < end; ++i) ++count[digit_of<1>(from[i])];
        return count;
    });
    deal_by_digit<1>(blocks, dealt, items, std::move(counts));

    Sorted sorted{core::UninitializedArray<Index>(n)};
    const auto less = [coordinate, before](Index a, Index b) {
        const double at_a = coordinate(a), at_b = coordinate(b);
        return at_a != at_b ? at_a < at_b : before(a, b);
    };
    const auto same_key = [&](std::size_t i) { return key_of(items[i]) == key_of(items[i - 1]); };
    const std::vector<char> distinct = blocks.results([&](std::size_t begin, std::size_t end) -> char {
        // Runs of one key belong to the block they begin in.
        while (begin > 0 && begin < end && same_key(begin)) ++begin;
        while (begin < end && end < n && same_key(end)) ++end;
        return sort_runs(items.data(), begin, end, sorted.order.data(), less);
    });
    sorted.distinct = std::find(distinct.begin(), distinct.end(), 0) == distinct.end();
    return sorted;
}

/// Nothing where a point lies outside the exact range.
std::optional<Box> checked_box(const Blocks& blocks, std::span<const Point> points) {
    struct Checked {
        Box box;
        bool in_range = true;
    };
    Checked whole;
    for (const Checked& part : blocks.results([&](std::size_t begin, std::size_t end) {
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

std::optional<SortedPoints> sort_points(std::span<const Point> points, core::BusyTimes* times) {
    const std::size_t n = points.size();
    const Blocks blocks(n, times);
    const std::optional<Box> box = checked_box(blocks, points);
    if (!box) return {};
    SortedPoints sorted;
    Sorted by_x = order_by(
        blocks, n, box->lower.x, box->upper.x, [points](std::size_t i) { return points[i].x; },
        [points](Index a, Index b) { return points[a].y < points[b].y; });
    if (!by_x.distinct) return {};
    sorted.original = std::move(by_x.order);
    sorted.points = core::UninitializedArray<Point>(n);
    blocks.for_each([&, to = sorted.points.data()](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) to[i] = points[sorted.original[i]];
    });
    sorted.by_y =
        order_by(
            blocks, n, box->lower.y, box->upper.y, [from = sorted.points.data()](std::size_t i) { return from[i].y; },
            [](Index a, Index b) { return a < b; })
            .order;
    sorted.y_rank = core::UninitializedArray<Index>(n);
    blocks.for_each([&, to = sorted.y_rank.data()](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) to[sorted.by_y[i]] = static_cast<Index>(i);
    });
    return sorted;
}

}  // namespace lamina::delaunay::pieces
