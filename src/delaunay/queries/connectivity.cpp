// Half-edges are dealt to ranges of vertices (deal.hpp). The rest of the work stays within a range, which fits in a
// cache.
#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include <lamina/delaunay_connectivity.hpp>
#include <lamina/error.hpp>

#include "core/arguments.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "delaunay/triangulate/deal.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

namespace {

/// Triangles of one block, and entries of one range, about.
constexpr std::size_t triangles_per_block = 1 << 15;
constexpr std::size_t vertices_per_range = 1 << 12;
constexpr std::size_t max_ranges = 1024;

/// Entries that are sorted by their ranges of vertices.
template <class Entry>
struct RangedEntries : DealtEntries<Entry> {
    unsigned shift;  ///< vertex v belongs to range v >> shift
};

/// Returns one entry for each half-edge, sorted by ranges of Entry::vertex; within a range they keep the order of the
/// half-edges. `entry_of` makes the entry of a triangle's corner.
template <class Entry, class EntryOf>
RangedEntries<Entry> deal_to_ranges(std::size_t points, std::size_t triangles, const EntryOf& entry_of) {
    unsigned shift = 0;
    while ((points >> shift) >= max_ranges || (std::size_t{1} << shift) < vertices_per_range) ++shift;
    return {deal<Entry>(
                3 * triangles, (points >> shift) + 1,
                [&](std::size_t h) { return entry_of(h / 3, static_cast<unsigned>(h % 3)); },
                [shift](const Entry& e) { return e.vertex >> shift; }),
            shift};
}

/// Entries of one range, sorted by their vertices.
template <class Entry>
struct SortedRange {
    std::vector<Entry> entries;
    std::vector<std::uint32_t> starts;  ///< of each vertex of the range, and one more

    SortedRange(std::span<const Entry> range, std::size_t first_vertex, std::size_t vertices)
        : entries(range.size()), starts(vertices + 1, 0) {
        for (const Entry& e : range) ++starts[e.vertex - first_vertex + 1];
        for (std::size_t v = 0; v < vertices; ++v) starts[v + 1] += starts[v];
        std::vector<std::uint32_t> place(starts.begin(), starts.end() - 1);
        for (const Entry& e : range) entries[place[e.vertex - first_vertex]++] = e;
    }
};

/// A half-edge at its smaller vertex.
struct EdgeSide {
    Index vertex;
    Index other;
    Index half_edge;
    bool starts_here;
};

/// An edge that does not have one triangle on each side, or less.
struct BadEdge {
    std::uint32_t first = no_half_edge, second = no_half_edge;
};

/// Joins the half-edges of one edge, of which there should be one or two that run against each other. Keeps the first
/// bad edge.
void join_sides(std::span<const EdgeSide> sides, std::vector<std::uint32_t>& twins, BadEdge& bad) {
    if (sides.size() == 1) {
        twins[sides[0].half_edge] = no_half_edge;
        return;
    }
    const bool opposed = sides.size() == 2 && sides[0].starts_here != sides[1].starts_here;
    if (opposed) {
        twins[sides[0].half_edge] = sides[1].half_edge;
        twins[sides[1].half_edge] = sides[0].half_edge;
    } else if (sides[0].half_edge < bad.first) {
        bad = {sides[0].half_edge, sides[1].half_edge};
    }
}

void check_triangle_count(std::size_t triangles) {
    if (triangles > max_triangles)
        throw InputError(
            {}, core::concat(triangles, " triangles are more than the ", max_triangles, " of one triangulation"));
}

[[noreturn]] void fail_bad_edge(std::span<const Triangle> triangles, BadEdge bad) {
    const std::size_t a = origin(triangles, bad.first).index(),
                      b = origin(triangles, next_half_edge(bad.first)).index();
    const std::size_t s = bad.first / 3, t = bad.second / 3;
    throw InputError(
        {.points = {a, b}, .triangles = {s, t}},
        core::concat("edge ", a, "-", b, " has more than one triangle on a side: triangles ", s, " and ", t));
}

/// Puts the half-edges of one point in counter-clockwise order.
void order_round_point(std::span<std::uint32_t> at_point, std::span<const std::uint32_t> twins) {
    std::vector<std::uint32_t> ordered;
    ordered.reserve(at_point.size());
    const auto turn_from = [&](std::uint32_t first) {
        std::uint32_t h = first;
        do {
            ordered.push_back(h);
            h = twins[previous_half_edge(h)];
        } while (h != no_half_edge && h != first && ordered.size() < at_point.size());
    };
    for (const std::uint32_t h : at_point)
        if (twins[h] == no_half_edge) turn_from(h);
    if (ordered.empty()) turn_from(at_point[0]);
    // Triangles that overlap may turn round a point more than once. Their order has no meaning, but none is lost.
    if (ordered.size() == at_point.size()) std::copy(ordered.begin(), ordered.end(), at_point.begin());
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

std::vector<std::uint32_t> half_edges(std::size_t points, std::span<const Triangle> triangles) {
    check_triangle_count(triangles.size());
    core::require_indices_below(points, triangles);
    const auto sides = deal_to_ranges<EdgeSide>(points, triangles.size(), [&](std::size_t t, unsigned i) -> EdgeSide {
        const Index a = triangles[t].v[i].value, b = triangles[t].v[next(i)].value;
        return {std::min(a, b), std::max(a, b), static_cast<Index>(3 * t + i), a < b};
    });
    std::vector<std::uint32_t> twins(3 * triangles.size());
    const auto bad = core::parallel_blocks(sides.ranges(), 1, [&](std::size_t r, std::size_t) {
        SortedRange<EdgeSide> sorted(sides.range(r), r << sides.shift, std::size_t{1} << sides.shift);
        BadEdge first_bad;
        for (std::size_t v = 0; v + 1 < sorted.starts.size(); ++v) {
            const auto begin = sorted.entries.begin() + sorted.starts[v],
                       end = sorted.entries.begin() + sorted.starts[v + 1];
            std::sort(begin, end, [](const EdgeSide& s, const EdgeSide& t) {
                return s.other != t.other ? s.other < t.other : s.half_edge < t.half_edge;
            });
            for (auto side = begin; side != end;) {
                const auto after = std::find_if(side, end, [&](const EdgeSide& s) { return s.other != side->other; });
                join_sides({&*side, static_cast<std::size_t>(after - side)}, twins, first_bad);
                side = after;
            }
        }
        return first_bad;
    });
    BadEdge first_bad;
    for (const BadEdge& b : bad)
        if (b.first < first_bad.first) first_bad = b;
    if (first_bad.first != no_half_edge) fail_bad_edge(triangles, first_bad);
    return twins;
}

std::vector<std::array<TriangleId, 3>> neighbours(std::span<const std::uint32_t> twins) {
    std::vector<std::array<TriangleId, 3>> result(twins.size() / 3);
    core::parallel_for(result.size(), triangles_per_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            for (unsigned e = 0; e < 3; ++e)
                // The edge opposite corner e starts at the next corner.
                if (const std::uint32_t twin = twins[3 * t + next(e)]; twin != no_half_edge)
                    result[t][e] = TriangleId{twin / 3};
    });
    return result;
}

IndexLists half_edges_at_points(std::size_t points, std::span<const Triangle> triangles,
                                std::span<const std::uint32_t> twins) {
    check_triangle_count(triangles.size());
    core::require_indices_below(points, triangles);
    core::require_count(twins.size(), "half-edges", 3 * triangles.size(), "corners");
    struct Start {
        Index vertex, half_edge;
    };
    const auto dealt = deal_to_ranges<Start>(points, triangles.size(), [&](std::size_t t, unsigned i) -> Start {
        return {triangles[t].v[i].value, static_cast<Index>(3 * t + i)};
    });
    IndexLists lists;
    lists.starts.resize(points + 1);
    lists.items.resize(twins.size());
    core::parallel_for(dealt.ranges(), 1, [&](std::size_t r, std::size_t) {
        const std::size_t first = r << dealt.shift;
        const std::size_t vertices = std::min(std::size_t{1} << dealt.shift, points - first);
        const SortedRange<Start> sorted(dealt.range(r), first, vertices);
        std::uint32_t* const items = lists.items.data() + dealt.starts[r];
        for (std::size_t i = 0; i < sorted.entries.size(); ++i) items[i] = sorted.entries[i].half_edge;
        for (std::size_t v = 0; v < vertices; ++v) {
            const std::uint32_t begin = sorted.starts[v], end = sorted.starts[v + 1];
            lists.starts[first + v + 1] = static_cast<std::uint32_t>(dealt.starts[r] + end);
            if (begin != end) order_round_point({items + begin, items + end}, twins);
        }
    });
    return lists;
}

IndexLists boundary_loops(std::span<const std::uint32_t> twins) {
    const auto blocks =
        core::parallel_blocks(twins.size(), 3 * triangles_per_block, [&](std::size_t begin, std::size_t end) {
            std::vector<std::uint32_t> boundary;
            for (std::size_t h = begin; h < end; ++h)
                if (twins[h] == no_half_edge) boundary.push_back(static_cast<std::uint32_t>(h));
            return boundary;
        });
    std::vector<std::uint32_t> boundary;
    for (const auto& block : blocks) boundary.insert(boundary.end(), block.begin(), block.end());
    const auto place = [&](std::uint32_t h) {
        return static_cast<std::size_t>(std::lower_bound(boundary.begin(), boundary.end(), h) - boundary.begin());
    };
    std::vector<char> seen(boundary.size(), 0);
    IndexLists loops;
    for (std::size_t i = 0; i < boundary.size(); ++i) {
        if (seen[i]) continue;
        for (std::uint32_t h = boundary[i]; !std::exchange(seen[place(h)], 1);) {
            loops.items.push_back(h);
            // The loop goes on at the end of h, round which the triangles lie clockwise from here to the next gap.
            for (h = next_half_edge(h); twins[h] != no_half_edge;) h = next_half_edge(twins[h]);
        }
        loops.starts.push_back(static_cast<std::uint32_t>(loops.items.size()));
    }
    return loops;
}

}  // namespace lamina
