// Points are sorted by the cells of a grid, on all threads. Equal ones then follow one another. Of those that have
// others near them the first takes all near it, then the next, one by one.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>
#include <lamina/triangulation.hpp>

#include "core/arguments.hpp"
#include "core/random.hpp"
#include "core/text.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/deal.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

namespace {

/// Mixes the bits of the coordinates. Equal points have equal hashes: adding 0 makes a zero of -0.
struct PointHash {
    std::size_t operator()(Point p) const {
        return core::splitmix64(core::splitmix64(std::bit_cast<std::uint64_t>(p.x + 0.0)) ^
                                std::bit_cast<std::uint64_t>(p.y + 0.0));
    }
};

/// Returns the number of ranges, a power of two, that as many points are dealt to.
std::size_t range_count(std::size_t points) {
    constexpr std::size_t points_per_range = 1 << 10, most_ranges = 1 << 12;
    return std::bit_ceil(std::clamp(points / points_per_range, std::size_t{1}, most_ranges));
}

/// A point in a cell of a grid.
struct PointInCell {
    Point cell, at;
    Index index;
};

/// Returns the cell of a grid of this width that a point lies in. With width 0 every point is its own cell.
Point cell_containing(Point p, double width) {
    return width > 0 ? Point{std::floor(p.x / width), std::floor(p.y / width)} : p;
}

/// Deals points to ranges by the cells of this width, and sorts each range by cells and then by the indices of the
/// points.
DealtEntries<PointInCell> deal_to_cells(std::span<const Point> points, double width) {
    const std::size_t ranges = range_count(points.size());
    DealtEntries<PointInCell> dealt = deal<PointInCell>(
        points.size(), ranges,
        [&](std::size_t i) {
            return PointInCell{cell_containing(points[i], width), points[i], static_cast<Index>(i)};
        },
        [&](const PointInCell& p) { return PointHash{}(p.cell) & (ranges - 1); });
    core::parallel_for(ranges, 1, [&](std::size_t r, std::size_t) {
        const std::span<PointInCell> range = dealt.range(r);
        std::sort(range.begin(), range.end(), [](const PointInCell& a, const PointInCell& b) {
            return a.cell == b.cell ? a.index < b.index : lexicographically_less(a.cell, b.cell);
        });
    });
    return dealt;
}

std::vector<Index> merge_equal_points(std::span<const Point> points) {
    const DealtEntries<PointInCell> dealt = deal_to_cells(points, 0);
    std::vector<Index> stand_in(points.size());
    core::parallel_for(dealt.ranges(), 1, [&](std::size_t r, std::size_t) {
        const std::span<const PointInCell> range = dealt.range(r);
        for (std::size_t i = 0, first = 0; i < range.size(); ++i) {
            if (range[i].at != range[first].at) first = i;
            stand_in[range[i].index] = range[first].index;
        }
    });
    return stand_in;
}

/// Returns for each point whether another one lies at most this far from it. True may stand where none does.
std::vector<char> have_near_points(std::span<const Point> points, double merge_distance) {
    // Most points are far from the borders of such cells, so that one cell is looked at, and no cell has many points
    // that are not near each other.
    const double width = 4 * merge_distance;
    const DealtEntries<PointInCell> dealt = deal_to_cells(points, width);
    const auto near_in_cell = [&](const PointInCell& p, Point cell) {
        const auto less = [](const PointInCell& a, Point c) { return lexicographically_less(a.cell, c); };
        const std::span<const PointInCell> range = dealt.range(PointHash{}(cell) & (dealt.ranges() - 1));
        for (auto at = std::lower_bound(range.begin(), range.end(), cell, less); at != range.end() && at->cell == cell;
             ++at)
            if (at->index != p.index && distance(at->at, p.at) <= merge_distance) return true;
        return false;
    };
    // Coordinates of near points differ by this much at most, and so lie in these three columns and rows of cells: the
    // distances above are rounded, too, and far from the origin a coordinate may have no other one near it.
    const double reach = merge_distance * (1 + 1e-9);
    const auto has_near_point = [&](const PointInCell& p) {
        const Point low = cell_containing(p.at - Point{reach, reach}, width),
                    high = cell_containing(p.at + Point{reach, reach}, width);
        const Point ends[] = {p.cell, low, high};
        for (unsigned i = 0; i < 3; ++i) {
            if (i > 0 && ends[i].x == p.cell.x) continue;
            for (unsigned k = 0; k < 3; ++k)
                if ((k == 0 || ends[k].y != p.cell.y) && near_in_cell(p, {ends[i].x, ends[k].y})) return true;
        }
        return false;
    };
    std::vector<char> near(points.size());
    core::parallel_for(dealt.ranges(), 1, [&](std::size_t r, std::size_t) {
        for (const PointInCell& p : dealt.range(r)) near[p.index] = has_near_point(p);
    });
    return near;
}

/// The points that stand for themselves, in a list for each cell. They are far from each other, so a list is short.
struct PointsInCells {
    std::unordered_map<Point, Index, PointHash> first;
    std::vector<Index> next;

    Index first_in(Point cell) const {
        const auto list = first.find(cell);
        return list == first.end() ? no_index : list->second;
    }

    void add(Index i, Point cell) {
        const auto [list, is_new] = first.try_emplace(cell, i);
        if (!is_new) next[i] = std::exchange(list->second, i);
    }
};

std::vector<Index> merge_close_points(std::span<const Point> points, double merge_distance) {
    PointsInCells kept{.first = {}, .next = std::vector<Index>(points.size(), no_index)};
    std::vector<Index> stand_in(points.size());
    // Beyond 2^53 cells from the origin the cells next to one may be the cell itself, and are, as are its points' own.
    const std::vector<char> near = have_near_points(points, merge_distance);
    // Returns the first point near point i of those that stand for themselves; i where there is none.
    const auto first_near = [&](Index i, Point cell) {
        Index found = i;
        for (const double dx : {-1.0, 0.0, 1.0})
            for (const double dy : {-1.0, 0.0, 1.0})
                for (Index k = kept.first_in({cell.x + dx + 0.0, cell.y + dy + 0.0}); k != no_index; k = kept.next[k])
                    if (k < found && distance(points[k], points[i]) <= merge_distance) found = k;
        return found;
    };
    for (Index i = 0; i < points.size(); ++i) {
        stand_in[i] = i;
        if (!near[i]) continue;
        const Point cell = cell_containing(points[i], merge_distance);
        stand_in[i] = first_near(i, cell);
        if (stand_in[i] == i) kept.add(i, cell);
    }
    return stand_in;
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

std::vector<std::uint32_t> merge_points(std::span<const Point> points, double distance) {
    if (!(distance >= 0 && distance <= max_exact_coordinate))
        throw OptionError("merge_distance", core::concat("must be from 0 to ", max_exact_coordinate));
    check_points(points);
    return distance == 0 ? merge_equal_points(points) : merge_close_points(points, distance);
}

std::vector<Segment> ring_segments(std::size_t points, std::span<const std::size_t> starts) {
    std::vector<Segment> segments;
    for (std::size_t r = 0; r < starts.size(); ++r) {
        const std::size_t begin = starts[r], end = r + 1 < starts.size() ? starts[r + 1] : points;
        if (begin > end || end > points)
            throw InputError({.points = {begin}},
                             core::concat("ring ", r, " runs from point ", begin, " to point ", end, " of ", points));
        for (std::size_t i = begin; i < end; ++i)
            segments.push_back({VertexId{i}, VertexId{i + 1 < end ? i + 1 : begin}});
    }
    return segments;
}

}  // namespace lamina
