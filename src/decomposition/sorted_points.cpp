// Sorting by buckets: a coordinate is mapped to 32 bits, points are dealt to buckets by the leading ones, every bucket
// to small ones by those that follow, and what is left is sorted by comparison of the coordinates themselves. So an
// even spread costs a fixed number of steps a point, and no spread costs more than a comparison sort.
#include "decomposition/sorted_points.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "core/parallel.hpp"

namespace lamina::decomposition {

namespace {

constexpr unsigned key_bits = 32;
constexpr unsigned bucket_bits = 11;
constexpr std::size_t buckets = std::size_t{1} << bucket_bits;
constexpr std::size_t block = std::size_t{1} << 17;

/// The key above, the point's number below.
using Item = std::uint64_t;
constexpr Index number_of(Item item) { return static_cast<Index>(item); }
constexpr std::uint32_t key_of(Item item) { return static_cast<std::uint32_t>(item >> 32); }

struct Range {
    double low = HUGE_VAL, high = -HUGE_VAL;
};

using BucketStarts = std::array<std::uint32_t, buckets>;

/// A bucket by its next bits: about four items to a small bucket, where they are spread evenly.
template <class Less>
void sort_bucket(std::span<Item> items, std::span<Item> scratch, std::vector<std::uint32_t>& starts, Less&& less) {
    constexpr std::size_t few = 24;
    if (items.size() <= few) return std::sort(items.begin(), items.end(), less);
    const unsigned bits = std::min(key_bits - bucket_bits, static_cast<unsigned>(std::bit_width(items.size() / 4)));
    const unsigned shift = 32 + key_bits - bucket_bits - bits;
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    const auto small_bucket = [&](Item i) { return i >> shift & mask; };
    starts.assign((std::size_t{1} << bits) + 1, 0);
    for (const Item i : items) ++starts[small_bucket(i) + 1];
    for (std::size_t b = 1; b < starts.size(); ++b) starts[b] += starts[b - 1];
    for (const Item i : items) scratch[starts[small_bucket(i)]++] = i;
    std::size_t begin = 0;
    for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
        const std::size_t end = starts[b];  // where the next small bucket begins
        const auto first = scratch.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = scratch.begin() + static_cast<std::ptrdiff_t>(end);
        if (end - begin > 1) std::sort(first, last, less);
        begin = end;
    }
    std::copy(scratch.begin(), scratch.end(), items.begin());
}

/// Numbers 0 to n - 1 by their coordinate; `before` orders numbers whose coordinates are the same.
template <class Coordinate, class Before>
std::vector<Index> order_by(std::size_t n, Coordinate&& coordinate, Before&& before) {
    const auto less = [&](Item l, Item r) {
        if (key_of(l) != key_of(r)) return key_of(l) < key_of(r);
        const Index a = number_of(l), b = number_of(r);
        const double at_a = coordinate(a), at_b = coordinate(b);
        return at_a != at_b ? at_a < at_b : before(a, b);
    };
    Range whole;
    for (const Range& r : parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) {
             Range range;
             for (std::size_t i = begin; i < end; ++i) {
                 range.low = std::min(range.low, coordinate(i));
                 range.high = std::max(range.high, coordinate(i));
             }
             return range;
         }))
        whole = {std::min(whole.low, r.low), std::max(whole.high, r.high)};
    const double scale = whole.high > whole.low ? 0x1.fffffep31 / (whole.high - whole.low) : 0.0;

    std::vector<Item> items(n), dealt(n);
    const auto bucket_of = [](Item i) { return i >> (64 - bucket_bits); };
    std::vector<BucketStarts> starts = parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) {
        BucketStarts counts{};
        for (std::size_t i = begin; i < end; ++i) {
            const auto key = static_cast<std::uint32_t>((coordinate(i) - whole.low) * scale);
            items[i] = std::uint64_t{key} << 32 | i;
            ++counts[bucket_of(items[i])];
        }
        return counts;
    });
    std::vector<std::uint32_t> bucket_starts(buckets + 1);
    std::uint32_t sum = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        bucket_starts[b] = sum;
        for (BucketStarts& s : starts) sum += std::exchange(s[b], sum);
    }
    bucket_starts[buckets] = sum;
    parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
        BucketStarts& at = starts[begin / block];
        for (std::size_t i = begin; i < end; ++i) dealt[at[bucket_of(items[i])]++] = items[i];
    });
    std::vector<Index> order(n);
    parallel_for(buckets, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> small_starts;
        for (std::size_t b = begin; b < end; ++b) {
            const std::size_t first = bucket_starts[b], count = bucket_starts[b + 1] - first;
            sort_bucket(std::span(dealt).subspan(first, count), std::span(items).subspan(first, count), small_starts,
                        less);
            for (std::size_t i = first; i < first + count; ++i) order[i] = number_of(dealt[i]);
        }
    });
    return order;
}

}  // namespace

SortedPoints sort_points(std::span<const Point> points) {
    const std::size_t n = points.size();
    SortedPoints sorted;
    sorted.original = order_by(
        n, [&](std::size_t i) { return points[i].x; },
        [&](Index a, Index b) { return points[a].y != points[b].y ? points[a].y < points[b].y : a < b; });
    sorted.points.resize(n);
    parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sorted.points[i] = points[sorted.original[i]];
    });
    sorted.by_y = order_by(
        n, [&](std::size_t i) { return sorted.points[i].y; }, [](Index a, Index b) { return a < b; });
    sorted.y_rank.resize(n);
    parallel_for(n, block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sorted.y_rank[sorted.by_y[i]] = static_cast<Index>(i);
    });
    return sorted;
}

bool has_duplicates(const SortedPoints& sorted) {
    return std::adjacent_find(sorted.points.begin(), sorted.points.end()) != sorted.points.end();
}

}  // namespace lamina::decomposition
