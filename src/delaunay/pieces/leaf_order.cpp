// Rounds: N. Amenta, S. Choi, G. Rote, SoCG 2003. Strips in the place of a space-filling curve: J. Beardwood, J. H.
// Halton, J. M. Hammersley, Math. Proc. Camb. Phil. Soc. 55 (1959), as short as a Hilbert curve on even points.
//
//      +--.--+--.--+--.--+     A strip holds a range of the order by x. The order by y is dealt to the strips, upwards
//      |  |  :  |  :  |  |     to one and downwards to the next, which leaves each strip sorted. Earlier rounds have
//      |  |  :  |  :  |  |     fewer points and wider strips.
//      |  |  :  |  :  |  |
//      +--|--'--|--'--|--+
#include "delaunay/pieces/leaf_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "delaunay/brio.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// For the last round; measured (docs/decisions/0013).
std::size_t strip_count(const SortedPoints& sorted, const Subdomain& leaf) {
    const double width = sorted.points[leaf.by_x.all().back()].x - sorted.points[leaf.by_x.all().front()].x;
    const double height = sorted.points[leaf.by_y.all().back()].y - sorted.points[leaf.by_y.all().front()].y;
    const double points = static_cast<double>(leaf.size());
    const double aspect = std::clamp(height > 0 ? width / height : HUGE_VAL, 1 / points, points);
    return 1 + static_cast<std::size_t>(std::min(std::sqrt(points * aspect), points / 16));
}

/// The strip of each point by its place in the order by x, to a fraction of a strip.
class Strips {
public:
    Strips(std::span<const Index> by_x, std::size_t count) : first_(by_x.front()) {
        const Index range = by_x.back() - first_;
        while (range >> shift_ >= 16 * count) ++shift_;
        strip_.resize((range >> shift_) + 1);
        std::size_t cell = 0;
        for (std::size_t strip = 0; strip < count; ++strip) {
            const bool last = strip + 1 == count;
            const std::size_t end = last ? strip_.size() : (by_x[(strip + 1) * by_x.size() / count] - first_) >> shift_;
            for (; cell < end; ++cell) strip_[cell] = static_cast<Index>(strip);
        }
    }
    Index operator[](Index point) const { return strip_[(point - first_) >> shift_]; }

private:
    Index first_;
    unsigned shift_ = 0;
    std::vector<Index> strip_;
};

}  // namespace

std::vector<Index> leaf_order(const SortedPoints& sorted, const Subdomain& leaf) {
    using delaunay::insertion_rounds;
    const std::size_t count = strip_count(sorted, leaf);
    const Strips strips(leaf.by_x.all(), count);

    // A bucket for every strip of every round; those of a round are half as many as in the one after it.
    std::array<Index, insertion_rounds> first{};
    std::array<unsigned, insertion_rounds> shift{};
    Index buckets = 0;
    for (unsigned r = 0; r < insertion_rounds; ++r) {
        first[r] = buckets;
        shift[r] = insertion_rounds - 1 - r;
        buckets += static_cast<Index>((count - 1) >> shift[r]) + 1;
    }
    core::UninitializedArray<Index> bucket(leaf.size());
    std::vector<Index> place(buckets + 1, 0);
    for (std::size_t i = 0; i < leaf.size(); ++i) {
        const Index point = leaf.by_y[i];
        const unsigned round = delaunay::insertion_round(point);
        bucket[i] = first[round] + (strips[point] >> shift[round]);
        ++place[bucket[i] + 1];
    }
    for (Index b = 0; b < buckets; ++b) place[b + 1] += place[b];
    // Every other one is filled from its end.
    std::vector<Index> step(buckets, 1);
    for (Index b = buckets; b-- > 0;) {
        if (b % 2 == 0) continue;
        place[b] = place[b + 1] - 1;
        step[b] = static_cast<Index>(-1);
    }
    std::vector<Index> order(leaf.size());
    for (std::size_t i = 0; i < leaf.size(); ++i) {
        const Index b = bucket[i];
        order[place[b]] = leaf.by_y[i];
        place[b] += step[b];
    }
    return order;
}

}  // namespace lamina::delaunay::pieces
