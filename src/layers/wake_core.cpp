// The space between a base and the point where the layers of both sides meet behind it is cut into strips between
// chains. The first chain is the base, the last one a point. Chains end at stations, vertices of the wake, but for those
// of the layers on the base, which end at its corners:
//
//    wall ___________u_
//                    |\\'--s---.__
//                    ||||  |   |  '--s----.__           s  stations
//              base  ||||  |   |     |       '--s- end
//                    ||//  |   |  .--s---''
//                    |//.--s---''
//    wall -----------l'
//
// Ends on the edges between stations would make first cells beside the wake, a millionth of a chord high, meet them in
// angles of nearly 180 degrees (docs/decisions/0037).
#include "layers/wake_core.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// The next chain follows by the law where that makes a strip lower than this share of an edge of the wake.
constexpr double max_layer_share = 0.7;
/// The last station is at least this share of an edge before the end.
constexpr double min_last_share = 0.6;

/// The outermost cells between stations are this many first heights wide, like the first cells on the other side of the
/// wake; each one further in is wider by the ratio. Wide cells beside the first ones made a flow solver diverge.
constexpr double outermost_cell = 2, cell_ratio = 1.4;

/// A chain: how far behind the base it lies, the height of the strip below it, and whether it ends at stations.
struct ChainPlace {
    double height, strip;
    bool station;
};

std::vector<ChainPlace> place_chains(double depth, double edge, double ratio, const LayerGrowth& growth) {
    std::vector<ChainPlace> places;
    double of_law = 0;
    for (std::uint32_t n = 1;; ++n) {
        const double above = layer_height(growth, n);
        const double strip = above - of_law;
        // Half a strip before the first station, or more, so that the strip below it is no thinner than the last layer.
        if (strip >= max_layer_share * edge || above + 0.5 * strip >= edge) break;
        places.push_back({above, strip, false});
        of_law = above;
    }
    for (double height = edge; height <= depth - min_last_share * edge; height += edge) {
        places.push_back({height, edge, true});
        edge *= ratio;
    }
    return places;
}

/// Returns the shares of a chain's length at which its points lie: cells widen from both ends up to this width.
std::vector<double> shares_between_stations(double length, double widest, double outermost) {
    std::vector<double> half{0};
    double cell = outermost;
    while (half.back() + 1.5 * cell < 0.5 * length && cell < widest) {
        half.push_back(half.back() + cell);
        cell *= cell_ratio;
    }
    // The rest between both halves is divided evenly.
    const double rest = length - 2 * half.back();
    const double parts = std::max(1.0, std::ceil(rest / std::max(widest, cell)));
    std::vector<double> shares;
    for (const double at : half) shares.push_back(at / length);
    for (double part = 1; part < parts; ++part) shares.push_back((half.back() + rest * part / parts) / length);
    for (std::size_t i = half.size(); i-- > 0;) shares.push_back(1 - half[i] / length);
    return shares;
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
    const double base_cell = width / static_cast<double>(base_shares.size() - 1);
    for (const ChainPlace& place : place_chains(depth, edge, ratio, growth)) {
        const double share = place.height / depth;
        const Point a = right + share * (end - right), b = left + share * (end - left);
        const std::vector<double> shares =
            place.station ? shares_between_stations((1 - share) * width, std::max(place.strip, base_cell),
                                                    outermost_cell * growth.first_height)
                          : base_shares;
        std::vector<Point> chain{place.station ? a : right};
        for (std::size_t i = 1; i + 1 < shares.size(); ++i) chain.push_back(a + shares[i] * (b - a));
        chain.push_back(place.station ? b : left);
        if (place.station) core.stations.push_back(core.chains.size());
        core.chains.push_back(std::move(chain));
    }
    core.stations.push_back(core.chains.size());
    core.chains.push_back({end});
    return core;
}

}  // namespace lamina::layers
