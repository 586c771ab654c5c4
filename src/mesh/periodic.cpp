#include "mesh/periodic.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

namespace lamina::mesh {

namespace {

/// The vertices of a border, from the left to the right, and its edges between them.
struct Border {
    std::vector<VertexId> vertices;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  ///< the smaller index first
    std::vector<std::uint32_t> order;                            ///< of the edges, ascending

    Border(std::span<const Point> points, const Marker& marker) : order(marker.edges.size()) {
        const auto before = [&](VertexId a, VertexId b) {
            return lexicographically_less(points[a.index()], points[b.index()]);
        };
        for (const Segment& edge : marker.edges) vertices.insert(vertices.end(), {edge.a, edge.b});
        std::sort(vertices.begin(), vertices.end(), before);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        const auto place = [&](VertexId v) {
            const auto found = std::lower_bound(vertices.begin(), vertices.end(), v, before);
            return static_cast<std::uint32_t>(found - vertices.begin());
        };
        for (const Segment& edge : marker.edges) {
            const auto [low, high] = std::minmax({place(edge.a), place(edge.b)});
            edges.emplace_back(low, high);
        }
        std::iota(order.begin(), order.end(), std::uint32_t{0});
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return edges[a] < edges[b]; });
    }
};

}  // namespace

PeriodicSearch find_periodic_pair(std::span<const Point> points, std::span<const Marker> markers) {
    std::vector<std::size_t> periodic;
    for (std::size_t m = 0; m < markers.size(); ++m)
        if (markers[m].kind == MarkerKind::periodic && !markers[m].edges.empty()) periodic.push_back(m);
    if (periodic.empty()) return {};
    const auto refuse = [](std::string reason, Point at) {
        return PeriodicSearch{.mismatch = PeriodicMismatch{std::move(reason), at}};
    };
    const Marker& one = markers[periodic.front()];
    if (periodic.size() != 2)
        return refuse(fmt::format("{} markers are periodic, such as '{}', in place of two", periodic.size(), one.name),
                      points[one.edges.front().a.index()]);
    Border a(points, one), b(points, markers[periodic.back()]);
    const auto at = [&](VertexId v) { return points[v.index()]; };
    const auto lowest = [&](const Border& border) { return at(border.vertices.front()); };
    if (lowest(b).y < lowest(a).y || (lowest(b).y == lowest(a).y && lowest(b).x < lowest(a).x)) {
        std::swap(a, b);
        std::swap(periodic.front(), periodic.back());
    }
    PeriodicPair pair{periodic.front(), periodic.back(), lowest(b) - lowest(a), {}, {}};
    const std::string borders =
        fmt::format("the periodic borders '{}' and '{}'", markers[pair.first].name, markers[pair.second].name);
    if (a.vertices.size() != b.vertices.size() || a.edges.size() != b.edges.size())
        return refuse(fmt::format("{} have {} and {} edges", borders, a.edges.size(), b.edges.size()), lowest(a));
    for (std::size_t i = 0; i < a.vertices.size(); ++i) {
        const Point p = at(a.vertices[i]), q = at(b.vertices[i]);
        if (p + pair.translation != q || q - p != pair.translation)
            return refuse(fmt::format("{} are no exact copies: vertex {} has no twin", borders, a.vertices[i].value),
                          p);
        pair.vertices.emplace_back(a.vertices[i], b.vertices[i]);
    }
    for (std::size_t i = 0; i < a.order.size(); ++i) {
        if (a.edges[a.order[i]] != b.edges[b.order[i]])
            return refuse(fmt::format("{} are divided in different ways", borders),
                          at(a.vertices[a.edges[a.order[i]].first]));
        pair.edges.emplace_back(a.order[i], b.order[i]);
    }
    return {.pair = std::move(pair)};
}

namespace {

/// Adds the cells of one kind of all copies, those of one copy after those of another.
template <class Cell, class Number>
void add_cells(const std::vector<Cell>& cells, std::size_t copies, const Number& number, std::vector<Cell>& all) {
    for (std::size_t copy = 0; copy < copies; ++copy)
        for (Cell cell : cells) {
            for (VertexId& v : cell.v) v = number(copy, v);
            all.push_back(cell);
        }
}

/// Returns values of cells, triangles first, for the cells of all copies.
template <class T>
std::vector<T> repeated_values(const std::vector<T>& values, std::size_t triangles, std::size_t copies) {
    std::vector<T> all;
    if (values.empty()) return all;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(triangles);
    for (std::size_t copy = 0; copy < copies; ++copy) all.insert(all.end(), values.begin(), middle);
    for (std::size_t copy = 0; copy < copies; ++copy) all.insert(all.end(), middle, values.end());
    return all;
}

}  // namespace

Mesh joined_copies(const Mesh& mesh, std::size_t copies) {
    const auto [pair, mismatch] = find_periodic_pair(mesh.points, mesh.markers);
    if (!pair)
        throw UsageError(mismatch ? mismatch->reason : "the mesh has no periodic borders, so it cannot be repeated");
    const std::size_t n = mesh.points.size();
    // The first border of a copy is the second one of the copy below.
    std::vector<std::size_t> kept(copies * n);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    for (std::size_t copy = 0; copy + 1 < copies; ++copy)
        for (const auto& [first, second] : pair->vertices)
            kept[(copy + 1) * n + first.index()] = copy * n + second.index();
    Mesh all;
    std::vector<VertexId> numbers(copies * n);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i] != i) continue;
        numbers[i] = VertexId(all.points.size());
        const std::size_t copy = i / n, middle = (copies - 1) / 2;
        const double steps = static_cast<double>(copy) - static_cast<double>(middle);
        all.points.push_back(mesh.points[i % n] + steps * pair->translation);
    }
    const auto number = [&](std::size_t copy, VertexId v) { return numbers[kept[copy * n + v.index()]]; };
    add_cells(mesh.triangles, copies, number, all.triangles);
    add_cells(mesh.quads, copies, number, all.quads);
    all.region = repeated_values(mesh.region, mesh.triangles.size(), copies);
    all.layer = repeated_values(mesh.layer, mesh.triangles.size(), copies);
    all.piece = repeated_values(mesh.piece, mesh.triangles.size(), copies);
    for (std::size_t m = 0; m < mesh.markers.size(); ++m) {
        Marker marker{mesh.markers[m].name, mesh.markers[m].kind, {}};
        const std::size_t from = m == pair->second ? copies - 1 : 0, to = m == pair->first ? 1 : copies;
        for (std::size_t copy = from; copy < to; ++copy)
            for (const Segment& edge : mesh.markers[m].edges)
                marker.edges.push_back({number(copy, edge.a), number(copy, edge.b)});
        all.markers.push_back(std::move(marker));
    }
    return all;
}

}  // namespace lamina::mesh
