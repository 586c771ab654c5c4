// The space between a base and the point where the layers of both sides meet behind it is cut into strips between
// chains. The first chain is the base, the last one a point. Some chains end at stations, vertices of the wake. The
// chains between two of these belong to layers that are thinner than the edge of the wake beside them; they end at the
// station before:
//
//    wall ___________u_
//                    |\'--s---.__
//                    ||\  |\    '--s----.__           s  stations
//              base  |||  ||     |        '--s- end
//                    ||/  |/  .--s---''
//                    |/.--s--'
//    wall -----------l'
//
// Ends on the edges between stations would make first cells beside the wake, a millionth of a chord high, meet them in
// angles of nearly 180 degrees (docs/decisions/0037).
#include "layers/wake_core.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lamina::layers {

namespace {

/// The next chain follows by the law where that makes a strip lower than this share of an edge of the wake.
constexpr double max_layer_share = 0.7;
/// The last station is at least this share of an edge before the end.
constexpr double min_last_share = 0.6;

/// A chain: how far behind the base it lies, the height of the strip below it, and whether it ends at stations.
struct ChainPlace {
    double height, strip;
    bool station;
};

std::vector<ChainPlace> place_chains(double depth, double edge, double ratio, const LayerGrowth& growth) {
    std::vector<ChainPlace> places;
    double height = 0, next_station = edge, of_law = 0;
    for (std::uint32_t n = 1;; ++n) {
        const double above = layer_height(growth, n);
        const double strip = above - of_law < max_layer_share * edge ? above - of_law : edge;
        of_law = above;
        height += strip;
        if (height > depth - min_last_share * std::max(strip, edge)) return places;
        // Half a strip earlier is near enough, so that stations are at chains.
        const bool station = height + 0.5 * strip >= next_station;
        places.push_back({height, strip, station});
        if (!station) continue;
        edge *= ratio;
        next_station = height + edge;
    }
}

/// Returns the shares of a base's length at which its points lie.
std::vector<double> shares_along(std::span<const Point> base) {
    std::vector<double> shares{0};
    for (std::size_t i = 1; i < base.size(); ++i) shares.push_back(shares.back() + distance(base[i - 1], base[i]));
    const double length = shares.back();
    for (double& share : shares) share /= length;
    shares.back() = 1;
    return shares;
}

}  // namespace

WakeCore make_core(std::size_t element, std::span<const Point> base, Point end, double edge, double ratio,
                   const LayerGrowth& growth) {
    const Point right = base.front(), left = base.back();
    const double width = distance(right, left), depth = std::abs(cross(left - right, end - right)) / width;
    WakeCore core{.element = element, .chains = {std::vector<Point>(base.begin(), base.end())}, .stations = {}};
    if (base.size() == 2) core.chains[0].insert(core.chains[0].begin() + 1, midpoint(right, left));
    const std::vector<double> base_shares = shares_along(core.chains[0]);
    const std::size_t base_cells = base_shares.size() - 1;
    std::size_t cells = base_cells;
    for (const ChainPlace& place : place_chains(depth, edge, ratio, growth)) {
        if (!place.station && cells < 2) continue;  // nothing but its ends
        const double share = place.height / depth;
        const double cell = std::max(place.strip, width / static_cast<double>(base_cells));
        const double fitting = std::ceil((1 - share) * width / cell);
        if (place.station) cells = std::clamp<std::size_t>(static_cast<std::size_t>(fitting), 1, cells);
        const Point a = right + share * (end - right), b = left + share * (end - left);
        std::vector<Point> chain{place.station ? a : core.chains.back().front()};
        for (std::size_t i = 1; i < cells; ++i) {
            const double even = static_cast<double>(i) / static_cast<double>(cells);
            chain.push_back(a + (cells == base_cells ? base_shares[i] : even) * (b - a));
        }
        chain.push_back(place.station ? b : core.chains.back().back());
        if (place.station) core.stations.push_back(core.chains.size());
        core.chains.push_back(std::move(chain));
    }
    core.stations.push_back(core.chains.size());
    core.chains.push_back({end});
    return core;
}

}  // namespace lamina::layers
