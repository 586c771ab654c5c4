// Random rounds keep cavities small on any input; a space-filling curve inside each round keeps the walk from point to
// point short (N. Amenta, S. Choi, G. Rote, SoCG 2003).
// All points are put along the curve at once; then they are dealt to their rounds.
#include "delaunay/brio.hpp"

#include <array>

#include "delaunay/hilbert.hpp"

namespace lamina::delaunay {

namespace {

/// Bits of the key per axis. Points of a layer lie as close as 1e-6 of the extent.
constexpr unsigned hilbert_bits = 20;

}  // namespace

std::vector<Index> brio_order(std::span<const Point> points, const Box& box) {
    const CurveOrder along_curve(points, HilbertCurve<hilbert_bits>(box));
    std::array<std::size_t, brio_rounds + 1> start{};
    for (std::size_t i = 0; i < points.size(); ++i) ++start[brio_round(static_cast<Index>(i)) + 1];
    for (unsigned r = 1; r < brio_rounds; ++r) start[r] += start[r - 1];
    std::vector<Index> order(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto point = static_cast<Index>(along_curve[i]);
        order[start[brio_round(point)]++] = point;
    }
    return order;
}

}  // namespace lamina::delaunay
