// Parts are ranges of an order of triangles, in which neighbours are to be near each other. Two orders are tried.
#include "delaunay/pieces/triangle_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>

namespace lamina::delaunay::pieces {

namespace {

/// Divides an order of triangles into parts of equal size.
TriangleParts divide(std::vector<Index> order, std::size_t parts) {
    TriangleParts d;
    d.order = std::move(order);
    const std::size_t count = d.order.size();
    d.place.resize(count);
    d.part.resize(count);
    for (std::size_t k = 0; k <= parts; ++k) d.first.push_back(k * count / parts);
    for (std::size_t k = 0; k < parts; ++k)
        for (std::size_t i = d.first[k]; i < d.first[k + 1]; ++i) {
            d.place[d.order[i]] = static_cast<Index>(i);
            d.part[d.order[i]] = static_cast<Index>(k);
        }
    return d;
}

/// Returns whether few of the triangles have a neighbour in another part.
bool has_short_borders(const Tris& tris, const TriangleParts& division) {
    std::size_t count = 0;
    for (Index t = 0; t < tris.size(); ++t)
        count +=
            std::any_of(std::begin(tris[t].n), std::end(tris[t].n), [&](Link n) { return division.is_border(t, n); });
    return count <= tris.size() / 16;
}

/// Returns the triangles in the order of a breadth-first search from `start`.
std::vector<Index> breadth_first(const Tris& tris, Index start) {
    std::vector<Index> order{start};
    order.reserve(tris.size());
    std::vector<char> seen(tris.size(), 0);
    seen[start] = 1;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (const Link n : tris[order[i]].n)
            if (!std::exchange(seen[n.triangle()], 1)) order.push_back(n.triangle());
    return order;
}

/// Returns the shortest edge of a triangle that is no ghost, or the hull edge of a ghost.
std::array<Point, 2> shortest_edge(const GrowingTriangulation& grown, const Tri& t) {
    std::array<Point, 2> shortest{};
    double least = HUGE_VAL;
    for (unsigned e = 0; e < 3; ++e) {
        const Point a = grown.vertices[t.v[next(e)]], b = grown.vertices[t.v[previous(e)]];
        const double length2 = squared_length(b - a);  // NaN at the vertex at infinity
        if (!(length2 < least)) continue;
        least = length2;
        shortest = {a, b};
    }
    return shortest;
}

/// Returns the direction that edges have on the whole: the unit eigenvector of the larger eigenvalue of the sum of
/// d d^T, where d are their directions.
Point main_direction(std::span<const std::array<Point, 2>> edges) {
    double xx = 0, xy = 0, yy = 0;
    for (const auto& [a, b] : edges) {
        const double length = distance(a, b);
        if (!(length > 0)) continue;  // it is rounded to nothing
        const Point d = (1 / length) * (b - a);
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    const double larger = 0.5 * (xx + yy + std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy));
    const Point direction = xx >= yy ? Point{larger - yy, xy} : Point{xy, larger - xx};
    const double length = distance({}, direction);
    return length > 0 ? (1 / length) * direction : Point{1, 0};
}

/// Divides the triangles in the order of their shortest edges along the direction that these have on the whole. The
/// shortest edge of a triangle between two lines lies on one of them, and so does that of a needle along a line.
TriangleParts divide_across(const GrowingTriangulation& grown, std::size_t parts) {
    std::vector<std::array<Point, 2>> edges;
    edges.reserve(grown.tris.size());
    for (const Tri& t : grown.tris) edges.push_back(shortest_edge(grown, t));
    const Point direction = main_direction(edges);
    std::vector<std::pair<double, Index>> places(edges.size());
    for (Index t = 0; t < places.size(); ++t)
        places[t] = {std::min(dot(edges[t][0], direction), dot(edges[t][1], direction)), t};
    std::sort(places.begin(), places.end());
    std::vector<Index> order(places.size());
    std::vector<double> along(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) std::tie(along[i], order[i]) = places[i];
    TriangleParts division = divide(std::move(order), parts);
    division.direction = direction;
    division.along = std::move(along);
    return division;
}

}  // namespace

Index TriangleParts::near(Point p) const {
    const auto at = std::lower_bound(along.begin(), along.end() - 1, dot(p, direction));
    return order[static_cast<std::size_t>(at - along.begin())];
}

std::size_t TriangleParts::part_near(Point p) const {
    const double at = dot(p, direction);
    std::size_t k = 0, end = size();
    while (end - k > 1) {
        const std::size_t middle = (k + end) / 2;
        (at < along[first[middle]] ? end : k) = middle;
    }
    return k;
}

std::optional<TriangleParts> find_parts(const GrowingTriangulation& grown, std::size_t parts) {
    // Lines across are short between lines that run the same way, and in a fan; ...
    TriangleParts across = divide_across(grown, parts);
    if (has_short_borders(grown.tris, across)) return across;
    // ... rings round its centre are in a cross, where each triangle leads to the next one. The triangle that a search
    // finds last lies at an end, and layers seen from there are short.
    TriangleParts by_steps = divide(breadth_first(grown.tris, breadth_first(grown.tris, 0).back()), parts);
    if (has_short_borders(grown.tris, by_steps)) return by_steps;
    return {};
}

}  // namespace lamina::delaunay::pieces
