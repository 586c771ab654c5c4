// J. K. Pardue, thesis (2015), 4.2-4.5 and 6.3: cut axis by the shape of the bounding box, median point, stable
// partition of both orders in linear time. Cuts that will not do are tried again elsewhere.
#include "decomposition/decompose.hpp"

#include <algorithm>
#include <array>

#include "decomposition/border.hpp"
#include "decomposition/dividing_path.hpp"

namespace lamina::decomposition {

namespace {

constexpr double largest_share = 0.75;

/// Cuts in the order in which they are tried: across the longer side of the bounding box or the shorter one, at this
/// share of the points.
struct Trial {
    bool across_longer;
    double share;
};
constexpr std::array<Trial, 10> trials{{{true, 0.5},
                                        {true, 0.47},
                                        {true, 0.53},
                                        {true, 0.43},
                                        {true, 0.57},
                                        {false, 0.5},
                                        {true, 0.38},
                                        {true, 0.62},
                                        {false, 0.42},
                                        {false, 0.58}}};

/// What becomes of a path vertex.
struct PathVertex {
    Index vertex;
    bool to_low, to_high;
};

/// Deals an order to the two parts. `path` holds the path's vertices in this order. The low part stays in place.
template <class IsLow>
Order deal(Order& order, std::span<const PathVertex> path, std::size_t high_size, IsLow&& is_low) {
    Order high(high_size + 1);  // the entry behind the last may be written, too
    Index *to_low = order.data(), *to_high = high.data();
    const Index* from = order.data();
    const Index* const end = from + order.size();
    for (auto next = path.begin();; ++next) {
        const Index* const stop = next == path.end() ? end : std::find(from, end, next->vertex);
        for (; from != stop; ++from) {
            const Index i = *from;
            const bool low = is_low(i);
            *to_low = i;
            *to_high = i;
            to_low += low;
            to_high += !low;
        }
        if (next == path.end()) break;
        if (next->to_low) *to_low++ = next->vertex;
        if (next->to_high) *to_high++ = next->vertex;
        ++from;
    }
    order.shrink(static_cast<std::size_t>(to_low - order.data()));
    assert(to_high == high.data() + high_size);
    high.shrink(high_size);
    return high;
}

/// Both parts, where the cut will do.
std::optional<Halves> try_cut(const SortedPoints& sorted, Subdomain& subdomain, Axis axis, double share,
                              DecompositionStats& stats) {
    const Order& across = axis == Axis::x ? subdomain.by_x : subdomain.by_y;
    const std::size_t size = subdomain.size(), place = static_cast<std::size_t>(share * static_cast<double>(size));
    const Cut cut{axis, across[place]};
    const std::vector<Index> path = dividing_path(sorted, subdomain, cut);
    std::optional<DividedBorder> borders = divide_border(sorted, subdomain.border, path, cut);
    if (!borders) {
        ++stats.crossing_cuts;
        return {};
    }

    const auto rank = [&](Index i) { return axis == Axis::x ? i : sorted.y_rank[i]; };
    const Index rank_of_cut = rank(cut.at);
    std::size_t low_size = place, high_size = size - place;
    std::vector<PathVertex> vertices;
    for (std::size_t i = 0; i < path.size(); ++i) {
        vertices.push_back({path[i], borders->low_has[i] != 0, borders->high_has[i] != 0});
        (rank(path[i]) < rank_of_cut ? low_size : high_size) -= 1;
        low_size += vertices.back().to_low;
        high_size += vertices.back().to_high;
    }
    if (static_cast<double>(std::max(low_size, high_size)) > largest_share * static_cast<double>(size)) {
        ++stats.unbalanced_cuts;
        return {};
    }

    Halves halves;
    const auto deal_order = [&](Order Subdomain::*order, auto&& place_in_order, auto&& is_low) {
        std::sort(vertices.begin(), vertices.end(), [&](const PathVertex& l, const PathVertex& r) {
            return place_in_order(l.vertex) < place_in_order(r.vertex);
        });
        halves.high.*order = deal(subdomain.*order, vertices, high_size, is_low);
        halves.low.*order = std::move(subdomain.*order);
    };
    const auto deal_both = [&](auto&& is_low) {
        deal_order(
            &Subdomain::by_x, [](Index i) { return i; }, is_low);
        deal_order(
            &Subdomain::by_y, [&](Index i) { return sorted.y_rank[i]; }, is_low);
    };
    if (axis == Axis::x)
        deal_both([=](Index i) { return i < rank_of_cut; });
    else
        deal_both([=, &sorted](Index i) { return sorted.y_rank[i] < rank_of_cut; });
    assert(halves.low.size() == low_size);
    halves.low.border = std::move(borders->low);
    halves.high.border = std::move(borders->high);
    halves.low.depth = halves.high.depth = subdomain.depth + 1;
    return halves;
}

}  // namespace

bool is_leaf(const Subdomain& subdomain, const DecompositionOptions& options) {
    return subdomain.size() <= options.leaf_vertices || subdomain.depth >= options.depth ||
           subdomain.border.size() >= subdomain.size();
}

std::optional<Halves> cut_subdomain(const SortedPoints& sorted, Subdomain& subdomain, DecompositionStats& stats) {
    const std::span<const Point> points = sorted.points;
    const std::span<const Index> by_x = subdomain.by_x.all(), by_y = subdomain.by_y.all();
    const bool wide = points[by_x.back()].x - points[by_x.front()].x >= points[by_y.back()].y - points[by_y.front()].y;
    for (const Trial& trial : trials) {
        const Axis axis = wide == trial.across_longer ? Axis::x : Axis::y;
        if (std::optional<Halves> halves = try_cut(sorted, subdomain, axis, trial.share, stats)) return halves;
    }
    return {};
}

}  // namespace lamina::decomposition
