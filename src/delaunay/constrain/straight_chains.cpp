// Lines are joined at one vertex after the other: pieces of one segment first, then what is straight within rounding.
#include "delaunay/constrain/straight_chains.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/segments.hpp"

namespace lamina::delaunay {

namespace {

/// A line at one of its ends.
struct LineEnd {
    Index vertex, line;
    Index parent;  ///< no_index for a line that is a piece of no segment
};

/// A line at one of its ends, by the line through the vertex that it lies on.
struct Bearing {
    double slope;  ///< from -1 to 1, growing with the angle of the line through the vertex
    Index line, far;
    friend bool operator<(const Bearing& l, const Bearing& r) {
        return l.slope != r.slope ? l.slope < r.slope : l.line < r.line;
    }
};

double slope_of(Point along) {
    const double sum = std::abs(along.x) + std::abs(along.y);
    return (along.x < 0 || (along.x == 0 && along.y < 0) ? -along.y : along.y) / sum;
}

/// Joins lines to chains.
class ChainMaker {
public:
    ChainMaker(std::span<const Point> points, std::span<const Segment> lines, std::span<const double> unresolved)
        : points_(points), lines_(lines), unresolved_(unresolved), first_(lines.size()) {
        std::iota(first_.begin(), first_.end(), Index{0});
    }

    /// Joins the lines that end at one vertex. They are sorted by their parents.
    void join_at(std::span<const LineEnd> ends) {
        bearings_.clear();
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (i + 1 < ends.size() && ends[i].parent != no_index && ends[i].parent == ends[i + 1].parent) {
                join(ends[i].line, ends[i + 1].line);
                ++i;
                continue;
            }
            const Index line = ends[i].line, u = ends[i].vertex;
            const Index far = lines_[line].a.value == u ? lines_[line].b.value : lines_[line].a.value;
            bearings_.push_back({slope_of(points_[far] - points_[u]), line, far});
        }
        if (bearings_.size() > 1) join_straight(points_[ends.front().vertex]);
    }

    std::vector<Index> chains() {
        for (Index i = 0; i < first_.size(); ++i) first_[i] = first_of(i);
        return std::move(first_);
    }

private:
    /// Joins those that are next to each other by their bearings and lead to opposite sides. The last is next to the
    /// first: both may be vertical but for rounding.
    void join_straight(Point u) {
        std::sort(bearings_.begin(), bearings_.end());
        const std::size_t count = bearings_.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (i + 1 == count && count == 2) return;
            const Bearing& here = bearings_[i];
            const Bearing& there = bearings_[(i + 1) % count];
            if (!is_straight(points_[here.far], u, points_[there.far],
                             std::max(unresolved_[here.line], unresolved_[there.line])))
                continue;
            join(here.line, there.line);
            ++i;
        }
    }

    static bool is_straight(Point a, Point u, Point b, double unresolved) {
        return dot(a - u, b - u) < 0 && core::distance_to_segment(u, a, b) < unresolved;
    }

    Index first_of(Index line) {
        while (first_[line] != line) line = first_[line] = first_[first_[line]];
        return line;
    }

    void join(Index line, Index other) {
        const auto [first, last] = std::minmax({first_of(line), first_of(other)});
        first_[last] = first;
    }

    std::span<const Point> points_;
    std::span<const Segment> lines_;
    std::span<const double> unresolved_;
    std::vector<Index> first_;  ///< for each line an earlier one of its chain, or itself
    std::vector<Bearing> bearings_;
};

}  // namespace

std::vector<Index> straight_chains(std::span<const Point> points, std::span<const Segment> lines,
                                   std::span<const Index> parents, std::span<const double> unresolved_distances) {
    std::vector<LineEnd> ends;
    ends.reserve(2 * lines.size());
    for (Index i = 0; i < lines.size(); ++i)
        for (const VertexId v : {lines[i].a, lines[i].b})
            ends.push_back({v.value, i, i < parents.size() ? parents[i] : no_index});
    std::sort(ends.begin(), ends.end(), [](const LineEnd& l, const LineEnd& r) {
        if (l.vertex != r.vertex) return l.vertex < r.vertex;
        return l.parent != r.parent ? l.parent < r.parent : l.line < r.line;
    });
    ChainMaker maker(points, lines, unresolved_distances);
    for (std::size_t begin = 0; begin < ends.size();) {
        std::size_t end = begin;
        while (end < ends.size() && ends[end].vertex == ends[begin].vertex) ++end;
        if (end > begin + 1) maker.join_at(std::span(ends).subspan(begin, end - begin));
        begin = end;
    }
    return maker.chains();
}

}  // namespace lamina::delaunay
