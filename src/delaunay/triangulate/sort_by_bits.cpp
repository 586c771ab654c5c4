// On one thread items are dealt to buckets by 11 bits at a time, the lowest first. On several they are dealt by the
// highest bits first, in blocks, and then the buckets are sorted at the same time.
#include "delaunay/triangulate/sort_by_bits.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <lamina/threads.hpp>

#include "core/parallel.hpp"

namespace lamina::delaunay {

namespace {

constexpr unsigned digit_bits = 11;
constexpr std::size_t digits = std::size_t{1} << digit_bits;

std::size_t digit(std::uint64_t item, unsigned shift) { return item >> shift & (digits - 1); }

/// Sorts the items by their bits from first_bit to end_bit. `other` is scratch space of the same size.
void sort_range(std::span<std::uint64_t> items, std::span<std::uint64_t> other, unsigned first_bit, unsigned end_bit) {
    constexpr std::size_t min_radix_size = 2000;  // std::sort() is quicker below
    if (items.size() < min_radix_size) {
        std::sort(items.begin(), items.end());
        return;
    }
    bool is_moved = false;
    for (unsigned shift = first_bit; shift < end_bit; shift += digit_bits) {
        std::array<std::uint32_t, digits + 1> start{};
        for (const std::uint64_t k : items) ++start[digit(k, shift) + 1];
        for (std::size_t d = 1; d < digits; ++d) start[d] += start[d - 1];
        for (const std::uint64_t k : items) other[start[digit(k, shift)]++] = k;
        std::swap(items, other);
        is_moved = !is_moved;
    }
    if (is_moved) std::copy(items.begin(), items.end(), other.begin());
}

void sort_on_all_threads(std::vector<std::uint64_t>& items, unsigned first_bit, unsigned end_bit) {
    const unsigned shift = end_bit - digit_bits;
    constexpr std::size_t sort_block = 1 << 16;
    using Counts = std::array<std::uint32_t, digits>;
    auto start = core::parallel_blocks(items.size(), sort_block, [&](std::size_t begin, std::size_t end) {
        Counts count{};
        for (std::size_t i = begin; i < end; ++i) ++count[digit(items[i], shift)];
        return count;
    });
    std::array<std::uint32_t, digits + 1> bucket{};
    std::uint32_t sum = 0;
    for (std::size_t d = 0; d < digits; ++d) {
        for (Counts& block : start) {
            const std::uint32_t count = block[d];
            block[d] = sum;
            sum += count;
        }
        bucket[d + 1] = sum;
    }
    std::vector<std::uint64_t> dealt(items.size());
    core::parallel_for(items.size(), sort_block, [&](std::size_t begin, std::size_t end) {
        Counts& to = start[begin / sort_block];
        for (std::size_t i = begin; i < end; ++i) dealt[to[digit(items[i], shift)]++] = items[i];
    });
    items.swap(dealt);
    constexpr std::size_t buckets_at_once = 16;
    core::parallel_for(digits, buckets_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t d = begin; d < end; ++d) {
            const std::size_t first = bucket[d], size = bucket[d + 1] - bucket[d];
            sort_range(std::span(items).subspan(first, size), std::span(dealt).subspan(first, size), first_bit, shift);
        }
    });
}

}  // namespace

void sort_by_bits(std::vector<std::uint64_t>& items, unsigned first_bit, unsigned end_bit) {
    constexpr std::size_t many_items = 1 << 18;
    if (thread_count() > 1 && items.size() >= many_items) {
        sort_on_all_threads(items, first_bit, end_bit);
    } else {
        std::vector<std::uint64_t> other(items.size());
        sort_range(items, other, first_bit, end_bit);
    }
}

}  // namespace lamina::delaunay
