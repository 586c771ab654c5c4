// N. Amenta, S. Choi, G. Rote, Incremental constructions con BRIO, SoCG 2003: random rounds keep cavities small on any
// input, a space-filling curve inside each round keeps the walk from point to point short.
// Hilbert keys by the four-state table of the curve, four bits of each coordinate a step; all points are sorted along
// the curve at once by a least-significant-digit radix sort, then dealt to their rounds.
#include "delaunay/brio.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace lamina::delaunay {

namespace {

constexpr unsigned hilbert_bits = 20;  // per axis: layer points stand 1e-6 of the extent apart

// State = orientation of the curve in the current square; quadrant = 2 x-bit + y-bit.
//   state 0: visits (0,0) (0,1) (1,1) (1,0); 1: transposed; 2: transposed in the other diagonal; 3: turned by 180
constexpr std::uint8_t curve_position[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 1, 3, 0}, {2, 3, 1, 0}};
constexpr std::uint8_t next_state[4][4] = {{1, 0, 2, 0}, {0, 3, 1, 1}, {2, 2, 0, 3}, {3, 1, 3, 2}};

// Four steps at once: [state << 8 | four bits of x << 4 | four bits of y] is position << 2 | state afterwards.
constexpr unsigned table_bits = 4;
constexpr auto curve_table = [] {
    std::array<std::uint16_t, 4 << (2 * table_bits)> table{};
    for (unsigned i = 0; i < table.size(); ++i) {
        unsigned state = i >> (2 * table_bits), position = 0;
        for (unsigned bit = table_bits; bit-- > 0;) {
            const unsigned quadrant = (i >> (table_bits + bit) & 1u) << 1 | (i >> bit & 1u);
            position = position << 2 | curve_position[state][quadrant];
            state = next_state[state][quadrant];
        }
        table[i] = static_cast<std::uint16_t>(position << 2 | state);
    }
    return table;
}();

std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y) {
    static_assert(hilbert_bits % table_bits == 0);
    std::uint64_t key = 0;
    unsigned state = 0;
    for (int bit = hilbert_bits - table_bits; bit >= 0; bit -= table_bits) {
        const unsigned entry = curve_table[state << 8 | (x >> bit & 15u) << 4 | (y >> bit & 15u)];
        key = key << 8 | entry >> 2;
        state = entry & 3u;
    }
    return key;
}

void radix_sort(std::vector<std::uint64_t>& items, unsigned first_bit) {
    constexpr unsigned digit_bits = 11;
    constexpr std::size_t digits = std::size_t{1} << digit_bits;
    std::vector<std::uint64_t> other(items.size());
    for (unsigned shift = first_bit; shift < 64; shift += digit_bits) {
        std::array<std::uint32_t, digits + 1> start{};
        for (const std::uint64_t k : items) ++start[(k >> shift & (digits - 1)) + 1];
        for (std::size_t d = 1; d < digits; ++d) start[d] += start[d - 1];
        for (const std::uint64_t k : items) other[start[k >> shift & (digits - 1)]++] = k;
        items.swap(other);
    }
}

}  // namespace

std::vector<Index> insertion_order(std::span<const Point> points, const Box& box) {
    const double extent = std::max(box.width(), box.height());
    const double scale = extent > 0 ? ((1u << hilbert_bits) - 1) / extent : 0.0;

    // The key above, the index below; more than 2^24 points leave less of the key.
    const auto index_bits = static_cast<unsigned>(std::bit_width(points.size()));
    const unsigned key_bits = std::min(2 * hilbert_bits, 64 - index_bits);
    std::vector<std::uint64_t> items(points.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const auto x = static_cast<std::uint32_t>((points[i].x - box.lower.x) * scale);
        const auto y = static_cast<std::uint32_t>((points[i].y - box.lower.y) * scale);
        items[i] = hilbert_key(x, y) >> (2 * hilbert_bits - key_bits) << (64 - key_bits) | i;
    }
    constexpr std::size_t radix_pays = 2000;
    if (items.size() < radix_pays)
        std::sort(items.begin(), items.end());
    else
        radix_sort(items, 64 - key_bits);

    const std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;
    std::array<std::size_t, insertion_rounds + 1> start{};
    for (std::size_t i = 0; i < items.size(); ++i) ++start[insertion_round(static_cast<Index>(i)) + 1];
    for (unsigned r = 1; r < insertion_rounds; ++r) start[r] += start[r - 1];
    std::vector<Index> order(items.size());
    for (const std::uint64_t item : items) {
        const auto point = static_cast<Index>(item & index_mask);
        order[start[insertion_round(point)]++] = point;
    }
    return order;
}

}  // namespace lamina::delaunay
