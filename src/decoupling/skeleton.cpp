// Lines are traced as edges between the corners where they meet. Each border begins where it would begin if all its
// segments were traced, line by line, those to the left of the line before those to its right.
#include "decoupling/skeleton.hpp"

#include <cassert>
#include <utility>

#include "decoupling/separators.hpp"
#include "decoupling/shared_search.hpp"
#include "decoupling/traced_border.hpp"

namespace lamina::decoupling {

void Skeleton::add_loop(std::span<const VertexId> loop) {
    const std::uint32_t line = lines.add_loop(loop);
    corner_of_.reserve(corner_of_.size() + loop.size());
    const VertexId first = corner(loop.front());
    VertexId last = first;
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
        const VertexId next = i + 1 < loop.size() ? corner(loop[i + 1]) : first;
        ends_.push_back({std::exchange(last, next), next});
        edges_.push_back({line, i, true});
    }
}

std::uint32_t Skeleton::add_new_loop(std::vector<Point> loop) {
    const std::size_t first = corners_.size();
    corners_.insert(corners_.end(), loop.begin(), loop.end());
    const std::size_t n = loop.size();
    const std::uint32_t line = lines.add_new_loop(std::move(loop));
    for (std::uint32_t i = 0; i < n; ++i) {
        ends_.push_back({VertexId{first + i}, VertexId{first + (i + 1 < n ? i + 1 : 0)}});
        edges_.push_back({line, i, true});
    }
    return line;
}

std::uint32_t Skeleton::add_line(VertexId from, VertexId to, std::uint32_t min_segments, Sides traced) {
    const std::uint32_t line = lines.add_line({from}, {to}, min_segments);
    trace_line(line, from, to, traced);
    return line;
}

std::uint32_t Skeleton::add_row(const LineRow& row, Sides traced) {
    const std::uint32_t first = lines.add_row(row);
    if (traced.left || traced.right)
        for (std::uint32_t i = 0; i < row.count; ++i) trace_line(first + i, row.from(i), row.to(i), traced);
    return first;
}

VertexId Skeleton::corner(VertexId vertex) {
    const auto [at, is_new] = corner_of_.try_emplace(vertex.value, VertexId{corners_.size()});
    if (is_new) corners_.push_back(lines.point(LineVertex{vertex}));
    return at->second;
}

void Skeleton::trace_line(std::uint32_t line, VertexId from, VertexId to, Sides traced) {
    if (traced.left) {
        ends_.push_back({corner(from), corner(to)});
        edges_.push_back({line, 0, true});
    }
    if (traced.right) {
        ends_.push_back({corner(to), corner(from)});
        edges_.push_back({line, 0, false});
    }
}

LineLoop Skeleton::loop_of(std::span<const std::uint32_t> edges) const {
    LineLoop loop;
    const Edge& begin = edges_[edges.front()];
    for (const std::uint32_t e : edges) {
        const auto [line, place, forward] = edges_[e];
        const std::uint32_t n = lines.segments(line);
        if (lines.is_loop(line)) {
            // Other lines may begin at its vertices, and then it is passed in several stretches.
            if (!loop.stretches.empty() && loop.stretches.back().line == line && loop.stretches.back().last == place) {
                ++loop.stretches.back().last;
                ++loop.vertices;
            } else {
                loop.add({line, place, place + 1});
            }
        } else if (forward) {
            loop.add({line, 0, n});
        } else if (e == edges.front()) {
            loop.add({line, 1, 0});  // of its segments to the right of the line, the one at its begin comes first
        } else {
            loop.add({line, n, 0});
        }
    }
    if (const std::uint32_t n = lines.segments(begin.line); !begin.forward && n > 1) loop.add({begin.line, n, 1});
    assert(is_closed(loop, lines));
    return loop;
}

std::vector<LineBorder> Skeleton::trace() {
    std::vector<LineBorder> borders;
    for (const TracedBorder& region : trace_borders(corners_, ends_)) {
        LineBorder& border = borders.emplace_back();
        for (const auto& loop : region.loops) border.loops.push_back(loop_of(loop));
    }
    return borders;
}

void Skeleton::number_together(const SizeField& size, core::ConnectedRanks& ranks) {
    rings.share(region_shares(rings.size(), ranks.size()));
    std::vector<LineRun> runs(rings.runs().begin(), rings.runs().end());
    if (rings.size() == 0)  // lines round the domain
        for (std::uint32_t line = 0; line < lines.size(); ++line)
            if (!lines.is_loop(line)) runs.push_back({line, line + 1, line % ranks.size()});
    decoupling::number_together(lines, runs, size, ranks);
}

std::vector<Segment> edges_along(const Lines& lines, std::uint32_t line) {
    std::vector<Segment> edges;
    const std::uint32_t n = lines.segments(line);
    edges.reserve(n);
    VertexId last = lines.id(line, 0);
    for (std::uint32_t i = 1; i <= n; ++i) {
        // The ids inside a line follow one another.
        const VertexId next = i == 1 || i == n ? lines.id(line, i) : VertexId{last.index() + 1};
        edges.push_back({std::exchange(last, next), next});
    }
    return edges;
}

std::vector<Segment> add_far_field_outline(Skeleton& skeleton, const FarField& far_field, const SizeField& size) {
    constexpr std::size_t min_segments_of_circle = 16;
    std::vector<Point> loop;
    if (far_field.shape == FarFieldShape::circle) {
        loop = divide_circle(far_field.center, far_field.radius, size, min_segments_of_circle);
    } else {
        for (std::size_t i = 0; i < far_field.outline.size(); ++i) {
            const Point u = far_field.outline[i], v = far_field.outline[(i + 1) % far_field.outline.size()];
            loop.push_back(u);
            for (const Point p : divide_separator(u, v, size, min_segments_of_side)) loop.push_back(p);
        }
    }
    return edges_along(skeleton.lines, skeleton.add_new_loop(std::move(loop)));
}

}  // namespace lamina::decoupling
