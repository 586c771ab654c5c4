// Equal points are found by sorting, close ones in a grid whose cells are as wide as the distance.
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
#include "delaunay/arguments.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

namespace {

std::vector<Index> merge_equal_points(std::span<const Point> points) {
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        return points[a] == points[b] ? a < b : lexicographically_less(points[a], points[b]);
    });
    std::vector<Index> stand_in(points.size());
    Index first = no_index;
    for (const Index i : order) {
        if (first == no_index || points[first] != points[i]) first = i;
        stand_in[i] = first;
    }
    return stand_in;
}

struct CellHash {
    std::size_t operator()(Point cell) const {
        return core::splitmix64(core::splitmix64(std::bit_cast<std::uint64_t>(cell.x)) ^
                                std::bit_cast<std::uint64_t>(cell.y));
    }
};

std::vector<Index> merge_close_points(std::span<const Point> points, double merge_distance) {
    // Points that stand for themselves are far from each other, so a cell holds few: they form a list for each cell.
    std::unordered_map<Point, Index, CellHash> first_in_cell;
    std::vector<Index> next_in_cell(points.size(), no_index), stand_in(points.size());
    // Beyond 2^53 cells from the origin the cells next to one may be the cell itself, and are, as are its points' own.
    // Adding 0 makes a zero of -0.
    const auto cell_of = [&](Point p) {
        return Point{std::floor(p.x / merge_distance) + 0.0, std::floor(p.y / merge_distance) + 0.0};
    };
    for (Index i = 0; i < points.size(); ++i) {
        const Point cell = cell_of(points[i]);
        Index found = i;
        for (const double dx : {-1.0, 0.0, 1.0})
            for (const double dy : {-1.0, 0.0, 1.0}) {
                const auto list = first_in_cell.find({cell.x + dx + 0.0, cell.y + dy + 0.0});
                if (list == first_in_cell.end()) continue;
                for (Index k = list->second; k != no_index; k = next_in_cell[k])
                    if (k < found && distance(points[k], points[i]) <= merge_distance) found = k;
            }
        stand_in[i] = found;
        if (found != i) continue;
        const auto [list, is_new] = first_in_cell.try_emplace(cell, i);
        if (!is_new) next_in_cell[i] = std::exchange(list->second, i);
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
