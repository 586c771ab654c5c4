// J. K. Pardue, thesis (2015), 4.2-4.5 and 6.3: the shape of the bounding box decides the axis of a cut, the cut runs
// through the median point, and both orders are partitioned stably in linear time. Where that cut is not good, others
// are tried.
#include "delaunay/pieces/cut_piece.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>

#include "delaunay/pieces/divide_border.hpp"
#include "delaunay/pieces/dividing_path.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// Neither part of a cut may hold more than this share of the points.
constexpr double max_share = 0.75;

/// A cut to try.
struct CutTrial {
    bool across_longer;  ///< across the longer side of the bounding box, or across the shorter one
    double share;        ///< of the points that come before the cut
};

/// All cuts to try, in this order.
constexpr std::array<CutTrial, 10> trials{{{true, 0.5},
                                           {true, 0.47},
                                           {true, 0.53},
                                           {true, 0.43},
                                           {true, 0.57},
                                           {false, 0.5},
                                           {true, 0.38},
                                           {true, 0.62},
                                           {false, 0.42},
                                           {false, 0.58}}};

/// A vertex of the path and the parts it belongs to: both, one or, outside of the region, neither.
struct PathVertex {
    Index vertex;
    bool in_low, in_high;
};

/// Partitions the order along the cut. Its low part stays in place; its high part, of `high_size` points, is returned.
/// `path` holds the path's vertices in this order. No branch depends on a point, but for the path's vertices: each
/// point is written to both parts, and only the part it belongs to moves on.
template <class IsLow>
PointOrder partition_along_cut(PointOrder& order, std::span<const PathVertex> path, std::size_t high_size,
                               IsLow&& is_low) {
    PointOrder high(high_size + 1);  // the entry behind the last may be written, too
    Index *to_low = order.data(), *to_high = high.data();
    const Index* from = order.data();
    // Distributes the next entries up to the one that `ends` says is the end.
    const auto distribute_until = [&](auto&& ends) {
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
        distribute_until([vertex = v.vertex](const Index* at) { return *at == vertex; });
        ++from;
        *to_low = v.vertex;
        *to_high = v.vertex;
        to_low += v.in_low;
        to_high += v.in_high;
    }
    distribute_until([end = order.end()](const Index* at) { return at == end; });
    order.shrink(static_cast<std::size_t>(to_low - order.data()));
    assert(to_high == high.data() + high_size);
    high.shrink(high_size);
    return high;
}

/// Copies the range [from, end) of an order to `to`, without those of the `vertices` that do not belong to the part.
/// Returns the end of the copy. `to` may be `from`: the points in front of the first such vertex then stay in place.
template <class Rank, class Belongs>
Index* copy_part(const Index* from, const Index* end, Index* to, std::span<const PathVertex> vertices, Rank&& rank,
                 Belongs&& belongs) {
    for (const PathVertex& v : vertices) {
        if (belongs(v)) continue;
        const Index* const at = std::partition_point(from, end, [&](Index i) { return rank(i) < rank(v.vertex); });
        to = from == to ? to + (at - from) : std::copy(from, at, to);
        from = at + 1;
    }
    return from == to ? to + (end - from) : std::copy(from, end, to);
}

/// Partitions the order across the cut, at the place of the cut. Its low part stays in place; its high part, of
/// `high_size` points, is returned. `path` holds the path's vertices in this order, and only these are looked at.
template <class Rank>
PointOrder partition_across_cut(PointOrder& order, std::size_t place, std::span<const PathVertex> path,
                                std::size_t high_size, Rank&& rank) {
    const auto first_behind = std::partition_point(
        path.begin(), path.end(), [&](const PathVertex& v) { return rank(v.vertex) < rank(order[place]); });
    const std::span<const PathVertex> before_cut(path.begin(), first_behind), behind_cut(first_behind, path.end());
    PointOrder high(high_size);
    Index* to_high = high.data();
    for (const PathVertex& v : before_cut)
        if (v.in_high) *to_high++ = v.vertex;
    to_high = copy_part(order.data() + place, order.end(), to_high, behind_cut, rank,
                        [](const PathVertex& v) { return v.in_high; });
    assert(to_high == high.end());
    Index* to_low = copy_part(order.data(), order.data() + place, order.data(), before_cut, rank,
                              [](const PathVertex& v) { return v.in_low; });
    for (const PathVertex& v : behind_cut)
        if (v.in_low) *to_low++ = v.vertex;
    order.shrink(static_cast<std::size_t>(to_low - order.data()));
    return high;
}

template <class Rank>
std::vector<PathVertex> sorted_by_rank(std::span<const PathVertex> vertices, Rank&& rank) {
    std::vector<std::uint64_t> keys(vertices.size());  // the rank in the upper half, the index in the lower one
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = std::uint64_t{rank(vertices[i].vertex)} << 32 | i;
    std::sort(keys.begin(), keys.end());
    std::vector<PathVertex> sorted(vertices.size());
    for (std::size_t i = 0; i < keys.size(); ++i) sorted[i] = vertices[static_cast<std::uint32_t>(keys[i])];
    return sorted;
}

/// A cut at a place of the order across it.
struct PlacedCut {
    Axis axis;
    std::size_t place;
    Index rank;  ///< of the cut's own point, among all points, in the order across
};

/// The vertices of a path with their parts, and the number of points in each part.
struct DividedPoints {
    std::vector<PathVertex> path;
    std::size_t low_size, high_size;
};

/// Finds out which vertices of the path belong to which part, and how large the parts are.
template <class Rank>
DividedPoints divide_points(std::size_t size, const PlacedCut& cut, std::span<const Index> path,
                            const DividedBorder& borders, Rank&& rank) {
    DividedPoints divided{{}, cut.place, size - cut.place};
    divided.path.reserve(path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
        const PathVertex v{path[i], borders.low.has_path_vertex[i] != 0, borders.high.has_path_vertex[i] != 0};
        divided.path.push_back(v);
        (rank(path[i]) < cut.rank ? divided.low_size : divided.high_size) -= 1;
        divided.low_size += v.in_low;
        divided.high_size += v.in_high;
    }
    return divided;
}

/// Partitions both orders of a piece.
template <class Rank>
PieceHalves partition_orders(const SortedPoints& sorted, Piece& piece, const PlacedCut& cut, DividedPoints divided,
                             Rank&& rank) {
    const std::vector<PathVertex> path_across = sorted_by_rank(divided.path, rank);
    std::vector<PathVertex>& path_along = divided.path;
    const std::size_t high_size = divided.high_size;
    PieceHalves halves;
    if (cut.axis == Axis::x) {
        halves.high.by_x = partition_across_cut(piece.by_x, cut.place, path_across, high_size, rank);
        halves.high.by_y = partition_along_cut(piece.by_y, path_along, high_size,
                                               [cut_rank = cut.rank](Index i) { return i < cut_rank; });
    } else {
        // The path runs against the order by x, because the coordinate along the cut is -x (CutFrame).
        std::reverse(path_along.begin(), path_along.end());
        halves.high.by_y = partition_across_cut(piece.by_y, cut.place, path_across, high_size, rank);
        halves.high.by_x = partition_along_cut(
            piece.by_x, path_along, high_size,
            [ranks = sorted.y_rank.begin(), cut_rank = cut.rank](Index i) { return ranks[i] < cut_rank; });
    }
    halves.low.by_x = std::move(piece.by_x);
    halves.low.by_y = std::move(piece.by_y);
    assert(halves.low.size() == divided.low_size && halves.low.by_y.size() == divided.low_size);
    assert(halves.high.size() == high_size && halves.high.by_y.size() == high_size);
    return halves;
}

/// Paths of this many points, and of a sixteenth of the piece beyond, are too long: both parts have their points, so
/// six such cuts would make the pieces together half as large again as the whole. Paths run round circles of points.
constexpr std::size_t long_path = 256;

/// Returns the two parts of a piece if the cut is good.
std::optional<PieceHalves> try_cut(const SortedPoints& sorted, Piece& piece, Axis axis, double share,
                                   DecompositionStats& stats) {
    const auto place = static_cast<std::size_t>(share * static_cast<double>(piece.size()));
    const Index cut_point = (axis == Axis::x ? piece.by_x : piece.by_y)[place];
    const std::vector<Index> path = dividing_path(sorted, piece, axis, place);
    if (path.size() > long_path + piece.size() / 16) {
        ++stats.long_cuts;
        return {};
    }
    std::optional<DividedBorder> borders = divide_border(sorted, piece.border, path, {axis, cut_point});
    if (!borders) {
        ++stats.crossing_cuts;
        return {};
    }

    const auto rank = [&](Index i) { return axis == Axis::x ? i : sorted.y_rank[i]; };
    const PlacedCut cut{axis, place, rank(cut_point)};
    DividedPoints divided = divide_points(piece.size(), cut, path, *borders, rank);
    const double larger = static_cast<double>(std::max(divided.low_size, divided.high_size));
    if (larger > max_share * static_cast<double>(piece.size())) {
        ++stats.unbalanced_cuts;
        return {};
    }

    PieceHalves halves = partition_orders(sorted, piece, cut, std::move(divided), rank);
    halves.low.border = std::move(borders->low.edges);
    halves.high.border = std::move(borders->high.edges);
    halves.low.depth = halves.high.depth = piece.depth + 1;
    assert(is_closed(halves.low.border) && is_closed(halves.high.border));
    return halves;
}

}  // namespace

bool is_leaf(const Piece& piece, const DecompositionOptions& options) {
    return piece.size() <= options.leaf_vertices || piece.depth >= options.depth || piece.border.size() >= piece.size();
}

std::optional<PieceHalves> cut_piece(const SortedPoints& sorted, Piece& piece, DecompositionStats& stats) {
    const std::span<const Point> points = sorted.points.all();
    const std::span<const Index> by_x = piece.by_x.all(), by_y = piece.by_y.all();
    const bool wide = points[by_x.back()].x - points[by_x.front()].x >= points[by_y.back()].y - points[by_y.front()].y;
    std::array<bool, 2> too_long{};  // for each axis whether a path was; those beside it will be, too
    for (const CutTrial& trial : trials) {
        if (too_long[trial.across_longer]) continue;
        const Axis axis = wide == trial.across_longer ? Axis::x : Axis::y;
        const std::size_t long_cuts = stats.long_cuts;
        if (std::optional<PieceHalves> halves = try_cut(sorted, piece, axis, trial.share, stats)) return halves;
        too_long[trial.across_longer] = stats.long_cuts > long_cuts;
    }
    piece.long_paths = too_long[0] && too_long[1];
    return {};
}

}  // namespace lamina::delaunay::pieces
