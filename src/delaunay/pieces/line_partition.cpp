#include "delaunay/pieces/line_partition.hpp"

#include <algorithm>
#include <optional>

namespace lamina::delaunay::pieces {

namespace {

/// Returns a number that is positive on the left of the line from a to b, 0 on it, and negative on its right.
double side_of(Point a, Point b, Point p) { return cross(b - a, p - a); }

/// The segments of a sample on both sides of a line.
struct Sides {
    std::vector<Segment> low, high;
    std::size_t crossing = 0;
};

Sides sides_of(std::span<const Point> points, const Segment& line, const std::vector<Segment>& sample) {
    Sides sides;
    const Point a = points[line.a.index()], b = points[line.b.index()];
    for (const Segment& s : sample) {
        const double p = side_of(a, b, points[s.a.index()]), q = side_of(a, b, points[s.b.index()]);
        if (p == 0 && q == 0) continue;
        if (p <= 0 && q <= 0)
            sides.low.push_back(s);
        else if (p >= 0 && q >= 0)
            sides.high.push_back(s);
        else
            ++sides.crossing;
    }
    return sides;
}

/// A line with what it does to a sample.
struct Division {
    Segment line;
    Sides sides;
};

/// Returns the best of some lines through segments of the sample, if any divides it well.
std::optional<Division> best_division(std::span<const Point> points, const std::vector<Segment>& sample) {
    constexpr std::size_t candidates = 9, least_sample = 16;
    if (sample.size() < least_sample) return std::nullopt;
    std::optional<Division> best;
    std::size_t least_cost = sample.size() * 3 / 4;
    for (std::size_t i = 0; i < candidates; ++i) {
        const Segment line = sample[(2 * i + 1) * sample.size() / (2 * candidates)];
        Sides sides = sides_of(points, line, sample);
        const std::size_t cost = std::max(sides.low.size(), sides.high.size()) + 2 * sides.crossing;
        if (cost >= least_cost) continue;
        least_cost = cost;
        best = Division{line, std::move(sides)};
    }
    return best;
}

}  // namespace

LinePartition::LinePartition(std::span<const Point> points, const std::vector<Segment>& sample) {
    constexpr unsigned depth = 4;  // 31 parts at most, 16 of them at the same time
    divide(points, sample, depth);
    const std::size_t n = parts_.size();
    common_.resize(n * n);
    for (std::size_t p = 0; p < n; ++p)
        for (std::size_t q = 0; q < n; ++q)
            for (std::size_t outer = 0; outer <= std::min(p, q); ++outer)  // those that hold both ascend inwards
                if (std::max(p, q) < parts_[outer].end) common_[p * n + q] = static_cast<Part>(outer);
}

void LinePartition::divide(std::span<const Point> points, const std::vector<Segment>& sample, unsigned depth) {
    const std::size_t part = parts_.size();
    parts_.emplace_back();
    const std::optional<Division> division = depth == 0 ? std::nullopt : best_division(points, sample);
    if (division) {
        parts_[part].a = points[division->line.a.index()];
        parts_[part].b = points[division->line.b.index()];
        parts_[part].sides[0] = static_cast<Part>(parts_.size());
        divide(points, division->sides.low, depth - 1);
        parts_[part].sides[1] = static_cast<Part>(parts_.size());
        divide(points, division->sides.high, depth - 1);
    }
    parts_[part].end = static_cast<Part>(parts_.size());
}

Part LinePartition::of_point(Point p) const {
    Part part = 0;
    while (is_divided(part)) {
        const double side = side_of(parts_[part].a, parts_[part].b, p);
        if (side == 0) break;
        part = parts_[part].sides[side > 0];  // a branch would be predicted wrongly every other time
    }
    return part;
}

Part LinePartition::of_segment(Part a, Part b) const {
    if (is_divided(a) && is_within(b, a)) return b;
    if (is_divided(b) && is_within(a, b)) return a;
    return common(a, b);
}

Part LinePartition::of_triangle(Part a, Part b, Part c) const {
    if (a == b && b == c) return a;
    const Part ab = common(a, b), bc = common(b, c), ca = common(c, a);
    if (is_divided(a) && is_within(bc, a)) return bc;
    if (is_divided(b) && is_within(ca, b)) return ca;
    if (is_divided(c) && is_within(ab, c)) return ab;
    return common(ab, c);
}

}  // namespace lamina::delaunay::pieces
