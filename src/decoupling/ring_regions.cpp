#include "decoupling/ring_regions.hpp"

#include <algorithm>
#include <cassert>

namespace lamina::decoupling {

namespace {

/// Returns who divides the lines round the bodies, as shares of the trapezoids beside them: those who cut there and
/// have no trapezoids, or else the processes that have them.
std::vector<std::size_t> shares_round_bodies(const std::vector<std::size_t>& shares, std::size_t trapezoids) {
    const auto cutters =
        static_cast<std::size_t>(std::upper_bound(shares.begin(), shares.end(), std::size_t{0}) - shares.begin() - 1);
    if (cutters == 0) return shares;
    std::vector<std::size_t> of_cutters;
    for (std::size_t i = 0; i <= cutters; ++i) of_cutters.push_back(trapezoids * i / cutters);
    return of_cutters;
}

}  // namespace

RingRegions::Place RingRegions::find(std::size_t trapezoid) const {
    const auto ring = static_cast<std::size_t>(std::upper_bound(end_.begin(), end_.end(), trapezoid) - end_.begin());
    return {rings_[ring], static_cast<std::uint32_t>(trapezoid - (ring > 0 ? end_[ring - 1] : 0))};
}

void RingRegions::share(const std::vector<std::size_t>& shares) {
    runs_.clear();
    // Adds the lines first_line + lines_before(t) to lines_before(t + 1) of each trapezoid t of a ring.
    const auto add_row = [&](const std::vector<std::size_t>& shares_of_row, std::size_t ring, std::uint32_t first_line,
                             auto&& lines_before) {
        const std::size_t begin = ring > 0 ? end_[ring - 1] : 0;
        auto process = static_cast<std::size_t>(std::upper_bound(shares_of_row.begin(), shares_of_row.end(), begin) -
                                                shares_of_row.begin());
        for (std::size_t next = begin; next < end_[ring]; ++process) {
            const std::size_t to = std::min(shares_of_row[process], end_[ring]);
            if (to == next) continue;
            const LineRun run{first_line + lines_before(next - begin), first_line + lines_before(to - begin),
                              static_cast<unsigned>(process - 1)};
            if (run.begin < run.end) runs_.push_back(run);
            next = to;
        }
    };
    const auto times = [](std::uint32_t n) {
        return [n](std::size_t trapezoids) { return n * static_cast<std::uint32_t>(trapezoids); };
    };
    if (!rings_.empty())
        add_row(shares_round_bodies(shares, end_.front()), 0, rings_.front().first_inner,
                times(rings_.front().inner_per_trapezoid));
    for (std::size_t ring = 0; ring < rings_.size(); ++ring)
        add_row(shares, ring, rings_[ring].first_outer, times(rings_[ring].outer_per_trapezoid));
    // A line that leads outwards is beside the trapezoid before it, and the first one beside the first trapezoid.
    for (std::size_t ring = 0; ring < rings_.size(); ++ring)
        add_row(shares, ring, rings_[ring].first_radial, [n = rings_[ring].trapezoids](std::size_t trapezoids) {
            return trapezoids == 0 ? 0 : std::min(static_cast<std::uint32_t>(trapezoids) + 1, n);
        });
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
    assert(is_closed(loop, lines));
    LineBorder border;
    border.loops.push_back(std::move(loop));
    return border;
}

}  // namespace lamina::decoupling
