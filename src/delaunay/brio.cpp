// Random rounds keep cavities small on any input; a space-filling curve inside each round keeps the walk from point to
// point short (N. Amenta, S. Choi, G. Rote, SoCG 2003).
// The Hilbert key of a point comes from the four-state table of the curve, four bits of each coordinate at a time. A
// least-significant-digit radix sort puts all points along the curve at once; then they are dealt to their rounds.
#include "delaunay/brio.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "core/bounding_box.hpp"

namespace lamina::delaunay {

namespace {

/// Bits of the key per axis. Points of a layer lie as close as 1e-6 of the extent.
constexpr unsigned hilbert_bits = 20;

// The state is the orientation of the curve in the current square; the quadrant is 2 x-bit + y-bit. In state 0 the
// curve visits (0,0) (0,1) (1,1) (1,0). State 1 is state 0 reflected in the diagonal x = y, state 2 in the other
// diagonal, and state 3 is state 0 turned by 180 degrees.
constexpr std::uint8_t curve_position[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 1, 3, 0}, {2, 3, 1, 0}};
constexpr std::uint8_t next_state[4][4] = {{1, 0, 2, 0}, {0, 3, 1, 1}, {2, 2, 0, 3}, {3, 1, 3, 2}};

/// Number of steps that the table below takes at once.
constexpr unsigned table_bits = 4;
/// Entry [state << 8 | four bits of x << 4 | four bits of y] is position << 2 | state after the steps.
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

/// Returns the position along the Hilbert curve of a cell of the grid of 2^hilbert_bits squared cells.
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

/// Sorts the items by their bits from `first_bit` up; items whose bits agree keep their order.
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

std::vector<Index> brio_order(std::span<const Point> points, const Box& box) {
    const double extent = core::longer_side(box);
    const double scale = extent > 0 ? ((1u << hilbert_bits) - 1) / extent : 0.0;

    // Each item holds the key in its upper bits and the index below. More than 2^24 points shorten the key.
    const auto index_bits = static_cast<unsigned>(std::bit_width(points.size()));
    const unsigned key_bits = std::min(2 * hilbert_bits, 64 - index_bits);
    std::vector<std::uint64_t> items(points.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const auto x = static_cast<std::uint32_t>((points[i].x - box.lower.x) * scale);
        const auto y = static_cast<std::uint32_t>((points[i].y - box.lower.y) * scale);
        items[i] = hilbert_key(x, y) >> (2 * hilbert_bits - key_bits) << (64 - key_bits) | i;
    }
    constexpr std::size_t min_radix_size = 2000;  // std::sort() is quicker below
    if (items.size() < min_radix_size)
        std::sort(items.begin(), items.end());
    else
        radix_sort(items, 64 - key_bits);

    const std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;
    std::array<std::size_t, brio_rounds + 1> start{};
    for (std::size_t i = 0; i < items.size(); ++i) ++start[brio_round(static_cast<Index>(i)) + 1];
    for (unsigned r = 1; r < brio_rounds; ++r) start[r] += start[r - 1];
    std::vector<Index> order(items.size());
    for (const std::uint64_t item : items) {
        const auto point = static_cast<Index>(item & index_mask);
        order[start[brio_round(point)]++] = point;
    }
    return order;
}

}  // namespace lamina::delaunay
