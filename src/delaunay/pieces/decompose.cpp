// J. K. Pardue, thesis (2015), 4.2-4.5 and 6.3: cut axis by the shape of the bounding box, median point, stable
// partition of both orders in linear time. Cuts that will not do are tried again elsewhere.
#include "delaunay/pieces/decompose.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "delaunay/pieces/border.hpp"
#include "delaunay/pieces/dividing_path.hpp"

namespace lamina::delaunay::pieces {

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

/// Deals the order along the cut to the two parts: no branch depends on a point, but for the path's vertices, which are
/// given in this order. The low part stays in place.
template <class IsLow>
Order deal(Order& order, std::span<const PathVertex> path, std::size_t high_size, IsLow&& is_low) {
    Order high(high_size + 1);  // the entry behind the last may be written, too
    Index *to_low = order.data(), *to_high = high.data();
    const Index* from = order.data();
    // The next entries up to the one that `ends` says is the end.
    const auto deal_until = [&](auto&& ends) {
        std::size_t taken = 0, low = 0;
        for (; !ends(from + taken); ++taken) {
            const Index i = from[taken];
            to_low[low] = i;
            to_high[taken - low] = i;
            low += is_low(i);
        }
        from += taken;
        to_low += low;
        to_high += taken - low;
    };
    for (const PathVertex& v : path) {
        deal_until([vertex = v.vertex](const Index* at) { return *at == vertex; });
        ++from;
        *to_low = v.vertex;
        *to_high = v.vertex;
        to_low += v.to_low;
        to_high += v.to_high;
    }
    deal_until([end = order.end()](const Index* at) { return at == end; });
    order.shrink(static_cast<std::size_t>(to_low - order.data()));
    assert(to_high == high.data() + high_size);
    high.shrink(high_size);
    return high;
}

/// Splits the order across the cut at the place of the cut: only the path's vertices, given in this order, are looked
/// at. The low part stays in place.
template <class Rank>
Order split(Order& order, std::size_t place, std::span<const PathVertex> path, std::size_t high_size, Rank&& rank) {
    const auto first_high = std::partition_point(
        path.begin(), path.end(), [&](const PathVertex& v) { return rank(v.vertex) < rank(order[place]); });
    // Copies [from, end) without the vertices that do not belong to a part.
    const auto copy = [&](const Index* from, const Index* end, Index* to, auto vertices, auto&& belongs) {
        for (const PathVertex& v : vertices) {
            if (belongs(v)) continue;
            const Index* const at = std::partition_point(from, end, [&](Index i) { return rank(i) < rank(v.vertex); });
            to = from == to ? to + (at - from) : std::copy(from, at, to);
            from = at + 1;
        }
        return from == to ? to + (end - from) : std::copy(from, end, to);
    };
    const std::span<const PathVertex> in_low(path.begin(), first_high), in_high(first_high, path.end());
    Order high(high_size);
    Index* to_high = high.data();
    for (const PathVertex& v : in_low)
        if (v.to_high) *to_high++ = v.vertex;
    to_high = copy(order.data() + place, order.end(), to_high, in_high, [](const PathVertex& v) { return v.to_high; });
    assert(to_high == high.end());
    Index* to_low =
        copy(order.data(), order.data() + place, order.data(), in_low, [](const PathVertex& v) { return v.to_low; });
    for (const PathVertex& v : in_high)
        if (v.to_low) *to_low++ = v.vertex;
    order.shrink(static_cast<std::size_t>(to_low - order.data()));
    return high;
}

template <class Rank>
std::vector<PathVertex> sorted_by(std::span<const PathVertex> vertices, Rank&& rank) {
    std::vector<std::uint64_t> places(vertices.size());  // the rank above
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = std::uint64_t{rank(vertices[i].vertex)} << 32 | i;
    std::sort(places.begin(), places.end());
    std::vector<PathVertex> sorted(vertices.size());
    for (std::size_t i = 0; i < places.size(); ++i) sorted[i] = vertices[static_cast<std::uint32_t>(places[i])];
    return sorted;
}

/// Both parts, where the cut will do.
std::optional<Halves> try_cut(const SortedPoints& sorted, Subdomain& subdomain, Axis axis, double share,
                              DecompositionStats& stats) {
    const Order& across = axis == Axis::x ? subdomain.by_x : subdomain.by_y;
    const std::size_t size = subdomain.size(), place = static_cast<std::size_t>(share * static_cast<double>(size));
    const Cut cut{axis, across[place]};
    const std::vector<Index> path = dividing_path(sorted, subdomain, axis, place);
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

    // In the orders along the cut and across it.
    const std::vector<PathVertex> sorted_vertices = sorted_by(vertices, rank);
    if (axis == Axis::y) std::reverse(vertices.begin(), vertices.end());
    Halves halves;
    if (axis == Axis::x) {
        halves.high.by_x = split(subdomain.by_x, place, sorted_vertices, high_size, rank);
        halves.high.by_y =
            deal(subdomain.by_y, vertices, high_size, [rank_of_cut](Index i) { return i < rank_of_cut; });
    } else {
        halves.high.by_y = split(subdomain.by_y, place, sorted_vertices, high_size, rank);
        halves.high.by_x =
            deal(subdomain.by_x, vertices, high_size,
                 [ranks = sorted.y_rank.begin(), rank_of_cut](Index i) { return ranks[i] < rank_of_cut; });
    }
    halves.low.by_x = std::move(subdomain.by_x);
    halves.low.by_y = std::move(subdomain.by_y);
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
    const std::span<const Point> points = sorted.points.all();
    const std::span<const Index> by_x = subdomain.by_x.all(), by_y = subdomain.by_y.all();
    const bool wide = points[by_x.back()].x - points[by_x.front()].x >= points[by_y.back()].y - points[by_y.front()].y;
    for (const Trial& trial : trials) {
        const Axis axis = wide == trial.across_longer ? Axis::x : Axis::y;
        if (std::optional<Halves> halves = try_cut(sorted, subdomain, axis, trial.share, stats)) return halves;
    }
    return {};
}

}  // namespace lamina::delaunay::pieces
