#include "delaunay/triangulate/arguments.hpp"

#include <algorithm>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

void check_points(std::span<const Point> points) {
    if (points.size() > max_triangles / 2)
        throw InputError(
            {}, core::concat(points.size(), " points are more than the ", max_triangles / 2, " of one triangulation"));
    core::require_exact_range(points, "point");
}

void check_points_and_segments(std::span<const Point> points, std::span<const Segment> segments) {
    check_points(points);
    core::require_indices_below(points.size(), segments);
}

void require_counter_clockwise(std::span<const Point> points, std::span<const Triangle> triangles) {
    constexpr std::size_t grain = 1 << 14;
    const auto bad = core::parallel_blocks(triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const auto& v = triangles[t].v;
            if (!(orient2d(points[v[0].index()], points[v[1].index()], points[v[2].index()]) > 0)) return t;
        }
        return triangles.size();
    });
    const auto first = std::min_element(bad.begin(), bad.end());
    if (first != bad.end() && *first < triangles.size())
        throw InputError({.triangles = {*first}}, core::concat("triangle ", *first, " is not counter-clockwise"));
}

std::vector<Segment> segments_between(std::span<const std::uint32_t> stand_in, std::span<const Segment> segments) {
    constexpr std::size_t grain = 50'000;
    std::vector<Segment> merged(segments.size());
    core::parallel_for(segments.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            merged[i] = {VertexId{stand_in[segments[i].a.index()]}, VertexId{stand_in[segments[i].b.index()]}};
    });
    return merged;
}

}  // namespace lamina::delaunay
