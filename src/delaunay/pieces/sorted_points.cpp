// A radix sort, block by block on all threads: a coordinate is mapped to a key of 24 bits, which ascends with it, and
// the points are distributed by 12 bits at a time, the lower ones first. Points with equal keys are then sorted by the
// coordinates themselves, so no input costs more than a comparison sort.
#include "delaunay/pieces/sorted_points.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <lamina/predicates.hpp>

#include "core/parallel.hpp"

namespace lamina::delaunay::pieces {

namespace {

constexpr unsigned digit_bits = 12;
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;
constexpr std::uint32_t key_values = 1u << 2 * digit_bits;

/// Runs work on blocks of [0, n), on all threads, and counts it as `cutting`.
class Blocks {
public:
    Blocks(std::size_t n, core::BusyTimes* times) : n_(n), times_(times) {}

    /// Calls f(begin, end) for every block.
    template <class F>
    void for_each(F&& f) const {
        core::parallel_for(n_, size, [&](std::size_t begin, std::size_t end) {
            const core::BusyTimes::Scope busy(times_, cutting);
            f(begin, end);
        });
    }
    /// Calls f(begin, end) for every block and returns the results in the order of the blocks.
    template <class F>
    auto results(F&& f) const {
        return core::parallel_blocks(n_, size, [&](std::size_t begin, std::size_t end) {
            const core::BusyTimes::Scope busy(times_, cutting);
            return f(begin, end);
        });
    }
    /// Returns the number of the block that begins at `begin`.
    static std::size_t number(std::size_t begin) { return begin / size; }

private:
    static constexpr std::size_t size = std::size_t{1} << 17;
    std::size_t n_;
    core::BusyTimes* times_;
};

/// A point to sort: its key in the upper half, its number in the lower half.
using KeyedPoint = std::uint64_t;
constexpr Index number_of(KeyedPoint p) { return static_cast<Index>(p); }
constexpr std::uint32_t key_of(KeyedPoint p) { return static_cast<std::uint32_t>(p >> 32); }
template <unsigned digit>
constexpr std::size_t digit_of(KeyedPoint p) {
    return p >> (32 + digit * digit_bits) & (digit_values - 1);
}

/// For each value of a digit the number of points with it in a block.
using DigitCounts = std::array<std::uint32_t, digit_values>;

/// Sorts the points by one digit, stably: points with equal digits keep their order. `counts` holds the counts of the
/// digit for every block.
template <unsigned digit>
void distribute_by_digit(const Blocks& blocks, const core::UninitializedArray<KeyedPoint>& points,
                         core::UninitializedArray<KeyedPoint>& distributed, std::vector<DigitCounts> counts) {
    // The counts become the places of the next point with each value.
    std::uint32_t sum = 0;
    for (std::size_t v = 0; v < digit_values; ++v)
        for (DigitCounts& c : counts) sum += std::exchange(c[v], sum);
    blocks.for_each([&](std::size_t begin, std::size_t end) {
        std::uint32_t* const places = counts[Blocks::number(begin)].data();
        const KeyedPoint* const from = points.begin();
        KeyedPoint* const to = distributed.data();
        for (std::size_t i = begin; i < end; ++i) to[places[digit_of<digit>(from[i])]++] = from[i];
    });
}

/// Copies the numbers of points that are sorted by their keys to `order`, and sorts runs of equal keys by `less`.
/// Returns false where two points are equal.
template <class Less>
bool sort_runs(const KeyedPoint* points, std::size_t begin, std::size_t end, Index* order, Less&& less) {
    bool distinct = true;
    std::uint32_t previous = key_values;
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t key = key_of(points[i]);
        order[i] = number_of(points[i]);
        if (std::exchange(previous, key) != key) continue;
        Index* const first = order + i - 1;
        while (i + 1 < end && key_of(points[i + 1]) == key) {
            ++i;
            order[i] = number_of(points[i]);
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

struct SortedNumbers {
    core::UninitializedArray<Index> order;
    bool distinct = true;  ///< no two numbers compare equal
};

/// Sorts the numbers 0 to n - 1 by their coordinates, which lie between `lower` and `upper`. `before` orders numbers
/// that have the same coordinate.
template <class Coordinate, class Before>
SortedNumbers sort_numbers(const Blocks& blocks, std::size_t n, double lower, double upper, Coordinate coordinate,
                           Before before) {
    const double scale = upper > lower ? (key_values - 1) / (upper - lower) : 0.0;
    core::UninitializedArray<KeyedPoint> points(n), distributed(n);
    std::vector<DigitCounts> counts = blocks.results([&, lower, coordinate](std::size_t begin, std::size_t end) {
        DigitCounts count{};
        KeyedPoint* const to = points.data();
        for (std::size_t i = begin; i < end; ++i) {
            to[i] = std::uint64_t{static_cast<std::uint32_t>((coordinate(i) - lower) * scale)} << 32 | i;
            ++count[digit_of<0>(to[i])];
        }
        return count;
    });
    distribute_by_digit<0>(blocks, points, distributed, std::move(counts));
    counts = blocks.results([from = distributed.data()](std::size_t begin, std::size_t end) {
        DigitCounts count{};
        for (std::size_t i = begin; i < end; ++i) ++count[digit_of<1>(from[i])];
        return count;
    });
    distribute_by_digit<1>(blocks, distributed, points, std::move(counts));

    SortedNumbers sorted{core::UninitializedArray<Index>(n)};
    const auto less = [coordinate, before](Index a, Index b) {
        const double at_a = coordinate(a), at_b = coordinate(b);
        return at_a != at_b ? at_a < at_b : before(a, b);
    };
    const auto continues_run = [&](std::size_t i) { return key_of(points[i]) == key_of(points[i - 1]); };
    const std::vector<char> distinct = blocks.results([&](std::size_t begin, std::size_t end) -> char {
        // A run of equal keys belongs to the block in which it begins.
        while (begin > 0 && begin < end && continues_run(begin)) ++begin;
        while (begin < end && end < n && continues_run(end)) ++end;
        return sort_runs(points.data(), begin, end, sorted.order.data(), less);
    });
    sorted.distinct = std::find(distinct.begin(), distinct.end(), 0) == distinct.end();
    return sorted;
}

/// Returns the box round the points, or nothing where a point lies outside the exact range.
std::optional<Box> checked_box(const Blocks& blocks, std::span<const Point> points) {
    struct CheckedBox {
        Box box;
        bool in_range = true;
    };
    CheckedBox whole;
    for (const CheckedBox& part : blocks.results([&](std::size_t begin, std::size_t end) {
             CheckedBox checked;
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
    SortedNumbers by_x = sort_numbers(
        blocks, n, box->lower.x, box->upper.x, [points](std::size_t i) { return points[i].x; },
        [points](Index a, Index b) { return points[a].y < points[b].y; });
    if (!by_x.distinct) return {};
    sorted.original = std::move(by_x.order);
    sorted.points = core::UninitializedArray<Point>(n);
    blocks.for_each([&, to = sorted.points.data()](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) to[i] = points[sorted.original[i]];
    });
    sorted.by_y =
        sort_numbers(
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
