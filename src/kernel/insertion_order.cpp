// N. Amenta, S. Choi, G. Rote, Incremental constructions con BRIO, SoCG 2003: random rounds keep cavities small on any
// input, a space-filling curve inside each round keeps the walk from point to point short.
// Hilbert keys by the four-state table of the curve, two bits a step; keys sorted by a least-significant-digit radix
// sort.
#include "kernel/insertion_order.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace lamina::kernel {

namespace {

constexpr unsigned hilbert_bits = 20;  // per axis: layer points stand 1e-6 of the extent apart
constexpr unsigned max_round = 15;

struct Keyed {
    std::uint64_t key;
    Index point;
};

// State = orientation of the curve in the current square; quadrant = 2 x-bit + y-bit.
//   state 0: visits (0,0) (0,1) (1,1) (1,0); 1: transposed; 2: transposed in the other diagonal; 3: turned by 180
constexpr std::uint8_t curve_position[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 1, 3, 0}, {2, 3, 1, 0}};
constexpr std::uint8_t next_state[4][4] = {{1, 0, 2, 0}, {0, 3, 1, 1}, {2, 2, 0, 3}, {3, 1, 3, 2}};

std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y) {
    std::uint64_t key = 0;
    unsigned state = 0;
    for (int bit = hilbert_bits - 1; bit >= 0; --bit) {
        const unsigned quadrant = ((x >> bit) & 1u) << 1 | ((y >> bit) & 1u);
        key = key << 2 | curve_position[state][quadrant];
        state = next_state[state][quadrant];
    }
    return key;
}

// splitmix64 (S. Vigna, public domain description): the program's random numbers are its own on every platform.
std::uint64_t scramble(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

// Round counted from the last: three quarters of all points are in round 0, three sixteenths in round 1, ...
unsigned round_from_last(Index point) {
    return std::min(static_cast<unsigned>(std::countr_zero(scramble(point) | 1ull << 63)) / 2, max_round);
}

void radix_sort(std::vector<Keyed>& items, unsigned key_bits) {
    constexpr unsigned digit_bits = 11;
    constexpr std::size_t digits = std::size_t{1} << digit_bits;
    std::vector<Keyed> other(items.size());
    for (unsigned shift = 0; shift < key_bits; shift += digit_bits) {
        std::array<std::size_t, digits + 1> start{};
        for (const Keyed& k : items) ++start[(k.key >> shift & (digits - 1)) + 1];
        for (std::size_t d = 1; d < digits; ++d) start[d] += start[d - 1];
        for (const Keyed& k : items) other[start[k.key >> shift & (digits - 1)]++] = k;
        items.swap(other);
    }
}

}  // namespace

std::vector<Index> insertion_order(std::span<const Point> points) {
    Box box;
    for (Point p : points) box.include(p);
    const double extent = std::max(box.width(), box.height());
    const double scale = extent > 0 ? ((1u << hilbert_bits) - 1) / extent : 0.0;

    std::vector<Keyed> items(points.size());
    for (Index i = 0; i < items.size(); ++i) {
        const auto x = static_cast<std::uint32_t>((points[i].x - box.lower.x) * scale);
        const auto y = static_cast<std::uint32_t>((points[i].y - box.lower.y) * scale);
        const std::uint64_t round = max_round - round_from_last(i);
        items[i] = {round << (2 * hilbert_bits) | hilbert_key(x, y), i};
    }
    const auto less = [](const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.point < b.point; };
    constexpr std::size_t radix_pays = 2000;
    if (items.size() < radix_pays)
        std::sort(items.begin(), items.end(), less);
    else
        radix_sort(items, 2 * hilbert_bits + 4);

    std::vector<Index> order(items.size());
    std::transform(items.begin(), items.end(), order.begin(), [](const Keyed& k) { return k.point; });
    return order;
}

}  // namespace lamina::kernel
