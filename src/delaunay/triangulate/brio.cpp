// Random rounds keep cavities small on any input; a space-filling curve inside each round keeps the walk from point to
// point short (N. Amenta, S. Choi, G. Rote, SoCG 2003).
// All points are put along the curve at once; then they are dealt to their rounds, block by block.
#include "delaunay/triangulate/brio.hpp"

#include <array>

#include "core/parallel.hpp"
#include "delaunay/triangulate/hilbert.hpp"

namespace lamina::delaunay {

namespace {

/// Bits of the key per axis. Points of a layer lie as close as 1e-6 of the extent.
constexpr unsigned hilbert_bits = 20;

constexpr std::size_t brio_block = 1 << 16;

/// For each round a number.
using PerRound = std::array<Index, brio_rounds>;

/// Changes the number of points of each round in each block into the place of the first of them in the order.
void add_up(std::vector<PerRound>& blocks) {
    Index sum = 0;
    for (unsigned r = 0; r < brio_rounds; ++r)
        for (PerRound& block : blocks) {
            const Index count = block[r];
            block[r] = sum;
            sum += count;
        }
}

}  // namespace

std::vector<Index> brio_order(std::span<const Point> points, const Box& box) {
    const CurveOrder along_curve(points, HilbertCurve<hilbert_bits>(box));
    const auto round_of = [&](std::size_t i) { return brio_round(static_cast<Index>(along_curve[i])); };
    auto places = core::parallel_blocks(points.size(), brio_block, [&](std::size_t begin, std::size_t end) {
        PerRound count{};
        for (std::size_t i = begin; i < end; ++i) ++count[round_of(i)];
        return count;
    });
    add_up(places);
    std::vector<Index> order(points.size());
    core::parallel_for(points.size(), brio_block, [&](std::size_t begin, std::size_t end) {
        PerRound& to = places[begin / brio_block];
        for (std::size_t i = begin; i < end; ++i) order[to[round_of(i)]++] = static_cast<Index>(along_curve[i]);
    });
    return order;
}

}  // namespace lamina::delaunay
