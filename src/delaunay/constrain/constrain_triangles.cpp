// Flips make any triangulation constrained Delaunay (C. L. Lawson, Software for C1 surface interpolation, 1977). The
// tie rule makes the result unique.
#include <algorithm>
#include <cassert>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/delaunay_connectivity.hpp>
#include <lamina/error.hpp>

#include "core/arguments.hpp"
#include "core/predicates.hpp"
#include "core/text.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/link_triangles.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay {

namespace {

/// Flips edges until all that are not constrained are locally Delaunay.
void flip_to_delaunay(std::span<const Point> points, Tris& tris) {
    std::vector<Link> edges;
    for (Index t = 0; t < tris.size(); ++t)
        for (unsigned e = 0; e < 3; ++e)
            if (const Link n = tris[t].n[e]; !n.is_constrained() && n.triangle() > t) edges.emplace_back(t, e);
    while (!edges.empty()) {
        const Link edge = edges.back();
        edges.pop_back();
        const Index t = edge.triangle();
        const Tri& tri = tris[t];
        const Link across = tri.n[edge.edge()];
        if (across.is_constrained()) continue;
        const Index n = across.triangle(), opposite = tris[n].v[across.edge()];
        if (core::inline_incircle_perturbed(points[tri.v[0]], points[tri.v[1]], points[tri.v[2]], points[opposite]) <=
            0)
            continue;
        flip_edge(tris, t, edge.edge());
        assert(is_counter_clockwise(points, tris[t]) && is_counter_clockwise(points, tris[n]));
        for (const Link around : {Link(t, 0), Link(t, 2), Link(n, 0), Link(n, 1)}) edges.push_back(around);
    }
}

/// The edges of triangles.
class EdgeKeys {
public:
    EdgeKeys(std::span<const Triangle> triangles, std::span<const std::uint32_t> twins) {
        keys_.reserve(twins.size());
        for (std::uint32_t h = 0; h < twins.size(); ++h)
            keys_.push_back(undirected_key(origin(triangles, h).value, origin(triangles, next_half_edge(h)).value));
        std::sort(keys_.begin(), keys_.end());
    }

    /// Returns the index of the first segment that is no edge, and not from a point to itself; their number if all are.
    std::size_t first_other(std::span<const Segment> segments) const {
        const auto is_other = [&](const Segment& s) {
            return s.a != s.b && !std::binary_search(keys_.begin(), keys_.end(), undirected_key(s.a.value, s.b.value));
        };
        return static_cast<std::size_t>(std::find_if(segments.begin(), segments.end(), is_other) - segments.begin());
    }

private:
    std::vector<std::uint64_t> keys_;
};

/// Returns for each point the one that stands for it where segments end: itself if a triangle has it, and else the
/// first equal one that a triangle has.
std::vector<Index> stand_ins_of_equal_points(std::span<const Point> points, std::span<const Triangle> triangles) {
    std::vector<char> used(points.size(), 0);
    for (const Triangle& t : triangles)
        for (const VertexId v : t.v) used[v.index()] = 1;
    const std::vector<Index> first = merge_points(points, 0);
    std::vector<Index> used_one(points.size(), no_index), stand_in(points.size());
    for (Index i = 0; i < points.size(); ++i)
        if (used[i] && used_one[first[i]] == no_index) used_one[first[i]] = i;
    for (Index i = 0; i < points.size(); ++i)
        stand_in[i] = used[i] || used_one[first[i]] == no_index ? i : used_one[first[i]];
    return stand_in;
}

/// Returns the segments that are parts of the result, each once.
void list_distinct_segments(std::span<const Segment> segments, ConstrainedTriangulation& result) {
    std::vector<std::uint64_t> seen;
    seen.reserve(segments.size());
    for (const Segment& s : segments) seen.push_back(undirected_key(s.a.value, s.b.value));
    std::sort(seen.begin(), seen.end());
    std::vector<char> listed(seen.size(), 0);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (segments[i].a == segments[i].b) {
            ++result.zero_length_segments;
            continue;
        }
        const std::uint64_t key = undirected_key(segments[i].a.value, segments[i].b.value);
        char& is_listed =
            listed[static_cast<std::size_t>(std::lower_bound(seen.begin(), seen.end(), key) - seen.begin())];
        result.repeated_segments += is_listed;
        if (is_listed) continue;
        is_listed = 1;
        result.segments.push_back(segments[i]);
        result.parents.push_back(static_cast<Index>(i));
    }
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

ConstrainedTriangulation constrain_triangles(std::span<const Point> points, std::span<const Triangle> triangles,
                                             std::span<const Segment> segments,
                                             std::span<const std::uint32_t> merged_into) {
    check_points_and_segments(points, segments);
    if (!merged_into.empty()) {
        core::require_count(merged_into.size(), "merged_into", points.size(), "points");
        for (std::size_t i = 0; i < merged_into.size(); ++i)
            if (merged_into[i] >= points.size())
                throw InputError({.points = {i}}, core::concat("merged_into: ", merged_into[i], " is none of the ",
                                                               points.size(), " points"));
    }
    const std::vector<std::uint32_t> twins = half_edges(points.size(), triangles);
    require_counter_clockwise(points, triangles);
    const EdgeKeys edges(triangles, twins);
    std::vector<Segment> merged;
    if (!merged_into.empty())
        merged = segments_between(merged_into, segments);
    else if (edges.first_other(segments) < segments.size())
        merged = segments_between(stand_ins_of_equal_points(points, triangles), segments);
    const std::span<const Segment> parts = merged.empty() ? segments : merged;
    if (const std::size_t i = edges.first_other(parts); i < parts.size())
        throw InputError({.segments = {i}},
                         core::concat(core::segment_name(segments, i), " is no edge of the triangles"));
    Tris tris = link_triangles(triangles, parts);
    flip_to_delaunay(points, tris);
    ConstrainedTriangulation result;
    result.triangles = without_ghosts(tris).triangles;
    list_distinct_segments(parts, result);
    result.merged_into.assign(merged_into.begin(), merged_into.end());
    return result;
}

}  // namespace lamina
