// Positions along a Hilbert curve, by which points that are close in the plane come close in memory, and the sort by
// them. The position comes from the four-state table of the curve, four bits of each coordinate at a time.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "core/bounding_box.hpp"
#include "core/parallel.hpp"
#include "delaunay/triangulate/sort_by_bits.hpp"

namespace lamina::delaunay {

// The state is the orientation of the curve in the current square; the quadrant is 2 x-bit + y-bit. In state 0 the
// curve visits (0,0) (0,1) (1,1) (1,0). State 1 is state 0 reflected in the diagonal x = y, state 2 in the other
// diagonal, and state 3 is state 0 turned by 180 degrees.
inline constexpr std::uint8_t curve_position[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 1, 3, 0}, {2, 3, 1, 0}};
inline constexpr std::uint8_t next_state[4][4] = {{1, 0, 2, 0}, {0, 3, 1, 1}, {2, 2, 0, 3}, {3, 1, 3, 2}};

/// Number of steps that the table below takes at once.
inline constexpr unsigned curve_table_bits = 4;
/// Entry [state << 8 | four bits of x << 4 | four bits of y] is position << 2 | state after the steps.
inline constexpr auto curve_table = [] {
    std::array<std::uint16_t, 4 << (2 * curve_table_bits)> table{};
    for (unsigned i = 0; i < table.size(); ++i) {
        unsigned state = i >> (2 * curve_table_bits), position = 0;
        for (unsigned bit = curve_table_bits; bit-- > 0;) {
            const unsigned quadrant = (i >> (curve_table_bits + bit) & 1u) << 1 | (i >> bit & 1u);
            position = position << 2 | curve_position[state][quadrant];
            state = next_state[state][quadrant];
        }
        table[i] = static_cast<std::uint16_t>(position << 2 | state);
    }
    return table;
}();

/// Maps points of a square box to positions along the curve through the 2^bits x 2^bits cells of the box.
template <unsigned bits>
class HilbertCurve {
    static_assert(bits % curve_table_bits == 0 && bits <= 28);

public:
    /// Precondition: the box is not empty.
    explicit HilbertCurve(const Box& box) : lower_(box.lower) {
        const double extent = core::longer_side(box);
        scale_ = extent > 0 ? ((1u << bits) - 1) / extent : 0.0;
    }
    /// Returns the position of a point of the box.
    std::uint64_t operator()(Point p) const {
        return position(static_cast<std::uint32_t>((p.x - lower_.x) * scale_),
                        static_cast<std::uint32_t>((p.y - lower_.y) * scale_));
    }

private:
    static std::uint64_t position(std::uint32_t x, std::uint32_t y) {
        std::uint64_t key = 0;
        unsigned state = 0;
        for (int bit = bits - curve_table_bits; bit >= 0; bit -= curve_table_bits) {
            const unsigned entry = curve_table[state << 8 | (x >> bit & 15u) << 4 | (y >> bit & 15u)];
            key = key << 8 | entry >> 2;
            state = entry & 3u;
        }
        return key;
    }

    Point lower_;
    double scale_ = 0;
};

/// Points in the order of their positions along the curve.
class CurveOrder {
public:
    /// Precondition: the curve was made for a box that holds the points.
    template <unsigned bits>
    CurveOrder(std::span<const Point> points, const HilbertCurve<bits>& curve)
        : index_bits_(static_cast<unsigned>(std::bit_width(points.size()))) {
        const unsigned key_bits = std::min(2 * bits, 64 - index_bits_);
        key_shift_ = 2 * bits - key_bits;
        items_.resize(points.size());
        core::parallel_for(points.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) items_[i] = key(curve(points[i])) << index_bits_ | i;
        });
        sort_by_bits(items_, index_bits_, index_bits_ + key_bits);
    }
    std::size_t size() const { return items_.size(); }
    /// Returns the index of the i-th point along the curve.
    std::size_t operator[](std::size_t i) const { return items_[i] & ((std::uint64_t{1} << index_bits_) - 1); }
    /// Returns its position, shortened as key() does.
    std::uint64_t key_at(std::size_t i) const { return items_[i] >> index_bits_; }
    /// Returns a position without the bits that do not fit beside an index.
    std::uint64_t key(std::uint64_t position) const { return position >> key_shift_; }
    /// Returns the number of those bits.
    unsigned key_shift() const { return key_shift_; }

private:
    unsigned index_bits_, key_shift_ = 0;
    std::vector<std::uint64_t> items_;
};

}  // namespace lamina::delaunay
