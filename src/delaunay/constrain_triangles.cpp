// Flips make any triangulation constrained Delaunay (C. L. Lawson, Software for C1 surface interpolation, 1977). The tie
// rule makes the result unique.
#include <algorithm>
#include <cassert>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/delaunay_connectivity.hpp>
#include <lamina/error.hpp>

#include "core/arguments.hpp"
#include "core/predicates.hpp"
#include "core/text.hpp"
#include "delaunay/arguments.hpp"
#include "delaunay/link_triangles.hpp"
#include "delaunay/triangulate_points.hpp"

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
        for (const Link around : {Link(t, 0), Link(t, 2), Link(n, 0), Link(n, 1)}) edges.push_back(around);
    }
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
                                             std::span<const Segment> segments) {
    check_points_and_segments(points, segments);
    const std::vector<std::uint32_t> twins = half_edges(points.size(), triangles);
    require_counter_clockwise(points, triangles);
    std::vector<std::uint64_t> edges;
    edges.reserve(twins.size());
    for (std::uint32_t h = 0; h < twins.size(); ++h)
        edges.push_back(undirected_key(origin(triangles, h).value, origin(triangles, next_half_edge(h)).value));
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Segment s = segments[i];
        if (s.a != s.b && !std::binary_search(edges.begin(), edges.end(), undirected_key(s.a.value, s.b.value)))
            throw InputError({.segments = {i}},
                             core::concat(core::segment_name(segments, i), " is no edge of the triangles"));
    }
    Tris tris = link_triangles(triangles, segments);
    flip_to_delaunay(points, tris);
    ConstrainedTriangulation result;
    result.triangles = without_ghosts(tris).triangles;
    list_distinct_segments(segments, result);
    return result;
}

}  // namespace lamina
