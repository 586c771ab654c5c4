#include "decoupling/ring_regions.hpp"

#include <algorithm>

namespace lamina::decoupling {

RingRegions::Place RingRegions::find(std::size_t trapezoid) const {
    const auto ring = static_cast<std::size_t>(std::upper_bound(end_.begin(), end_.end(), trapezoid) - end_.begin());
    return {rings_[ring], static_cast<std::uint32_t>(trapezoid - (ring > 0 ? end_[ring - 1] : 0))};
}

//      o----------- outer lines ---------->o
//       ^                                 /       The lines on the boxes run counter-clockwise and those between
//        \  radial j       radial j + 1  /        trapezoids outwards. Of the border's edges the first one of the
//         \                             v         first inner line, which is run along backwards, has the lowest
//          o<------ inner lines -------o          number.
LineBorder RingRegions::border(std::size_t trapezoid, const Lines& lines) const {
    const auto [ring, j] = find(trapezoid);
    LineLoop loop;
    const auto forward = [&](std::uint32_t line) { loop.add({line, 0, lines.segments(line)}); };
    const auto backward = [&](std::uint32_t line) { loop.add({line, lines.segments(line), 0}); };
    const std::uint32_t first = ring.first_inner + j * ring.inner_per_trapezoid;
    loop.add({first, 1, 0});
    forward(ring.first_radial + j);
    for (std::uint32_t i = 0; i < ring.outer_per_trapezoid; ++i)
        forward(ring.first_outer + j * ring.outer_per_trapezoid + i);
    backward(ring.first_radial + (j + 1 < ring.trapezoids ? j + 1 : 0));
    for (std::uint32_t i = ring.inner_per_trapezoid - 1; i > 0; --i) backward(first + i);
    loop.add({first, lines.segments(first), 1});
    LineBorder border;
    border.loops.push_back(std::move(loop));
    return border;
}

}  // namespace lamina::decoupling
