// Rounds: N. Amenta, S. Choi, G. Rote, SoCG 2003. Strips replace the space-filling curve: J. Beardwood, J. H. Halton,
// J. M. Hammersley, Math. Proc. Camb. Phil. Soc. 55 (1959); on even points they are as short as a Hilbert curve.
//
//      +--.--+--.--+--.--+     A strip holds a range of the order by x. The order by y is distributed to the strips,
//      |  |  :  |  :  |  |     upwards in one and downwards in the next, which leaves each strip sorted. Earlier rounds
//      |  |  :  |  :  |  |     have fewer points and wider strips.
//      |  |  :  |  :  |  |
//      +--|--'--|--'--|--+
#include "delaunay/pieces/leaf_brio.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "delaunay/triangulate/brio.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// Returns the number of strips of the last round: the root of the number of points in a square leaf. With half as many
/// layer points take 1.5 % more instructions.
std::size_t strip_count(const SortedPoints& sorted, const Piece& leaf) {
    const double width = sorted.points[leaf.by_x.all().back()].x - sorted.points[leaf.by_x.all().front()].x;
    const double height = sorted.points[leaf.by_y.all().back()].y - sorted.points[leaf.by_y.all().front()].y;
    const double points = static_cast<double>(leaf.size());
    const double aspect = std::clamp(height > 0 ? width / height : HUGE_VAL, 1 / points, points);
    return 1 + static_cast<std::size_t>(std::min(std::sqrt(points * aspect), points / 16));
}

/// Finds the strip of each point from its number, up to a fraction of a strip.
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
    Index first_;               ///< the smallest number of a point
    unsigned shift_ = 0;        ///< 2^shift_ successive numbers share a cell
    std::vector<Index> strip_;  ///< for each cell its strip
};

std::vector<Index> order_along_curve(const SortedPoints& sorted, std::span<const Index> numbers) {
    std::vector<Point> points;
    points.reserve(numbers.size());
    Box box;
    for (const Index i : numbers) {
        points.push_back(sorted.points[i]);
        box.include(points.back());
    }
    std::vector<Index> order = brio_order(points, box);
    for (Index& i : order) i = numbers[i];
    return order;
}

}  // namespace

std::vector<Index> leaf_brio(const SortedPoints& sorted, const Piece& leaf) {
    if (leaf.long_paths) return order_along_curve(sorted, leaf.by_x.all());
    const std::size_t count = strip_count(sorted, leaf);
    const Strips strips(leaf.by_x.all(), count);

    // Every strip of every round has a bucket. A round has half as many strips as the round after it.
    std::array<Index, brio_rounds> first{};
    std::array<unsigned, brio_rounds> shift{};
    Index buckets = 0;
    for (unsigned r = 0; r < brio_rounds; ++r) {
        first[r] = buckets;
        shift[r] = brio_rounds - 1 - r;
        buckets += static_cast<Index>((count - 1) >> shift[r]) + 1;
    }
    core::UninitializedArray<Index> bucket(leaf.size());
    std::vector<Index> place(buckets + 1, 0);
    for (std::size_t i = 0; i < leaf.size(); ++i) {
        const Index point = leaf.by_y[i];
        const unsigned round = brio_round(point);
        bucket[i] = first[round] + (strips[point] >> shift[round]);
        ++place[bucket[i] + 1];
    }
    for (Index b = 0; b < buckets; ++b) place[b + 1] += place[b];
    // Every other bucket is filled from its end.
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
