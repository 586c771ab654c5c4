#include "flow/euler/wake_line.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace lamina::flow::euler {

namespace {

/// The edge that a line crosses next, and the triangle that it comes from.
struct Crossing {
    std::uint32_t right, left;               ///< ends of the edge, on the right and on the left hand
    std::optional<std::uint32_t> from = {};  ///< none outside of the triangulation
};

/// Returns the edge opposite to the trailing edge in the triangle that the line enters.
std::optional<Crossing> first_crossing(const DualMesh& mesh, const std::vector<Triangle>& triangles,
                                       const WakeStart& start) {
    const auto to = [&](VertexId v) { return mesh.points[v.index()] - start.at; };
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& v = triangles[t].v;
            const VertexId right = v[(k + 1) % 3], left = v[(k + 2) % 3];
            if (v[k].value != start.corners[0]) continue;
            if (cross(start.direction, to(right)) <= 0 && cross(start.direction, to(left)) > 0)
                return Crossing{right.value, left.value, t};
        }
    return std::nullopt;
}

/// Returns the edge of the base that the line crosses.
std::optional<Crossing> base_crossing(const DualMesh& mesh, const WakeStart& start) {
    for (std::size_t k = 0; k + 1 < start.corners.size(); ++k) {
        const std::uint32_t right = start.corners[k], left = start.corners[k + 1];
        if (cross(start.direction, mesh.points[right] - start.at) <= 0 &&
            cross(start.direction, mesh.points[left] - start.at) > 0)
            return Crossing{right, left};
    }
    return std::nullopt;
}

Point mean_velocity(const Triangle& triangle, std::span<const Four> states) {
    Point sum;
    for (const VertexId v : triangle.v) sum = sum + velocity(states[v.index()]);
    return (1.0 / 3) * sum;
}

}  // namespace

NumberedTriangles numbered_triangles(const DualMesh& mesh, std::span<const Triangle> triangles) {
    std::vector<Triangle> numbered(triangles.begin(), triangles.end());
    for (Triangle& t : numbered)
        for (VertexId& v : t.v) v = VertexId(mesh.number_of[v.index()]);
    TrianglesAtEdges at_edges(numbered);
    return {std::move(numbered), std::move(at_edges)};
}

std::vector<WakePoint> trace_wake(const DualMesh& mesh, const NumberedTriangles& triangles,
                                  std::span<const Four> states, const WakeStart& start, double length, double near) {
    std::vector<WakePoint> line;
    const bool from_base = start.corners.size() > 1;
    std::optional<Crossing> next =
        from_base ? base_crossing(mesh, start) : first_crossing(mesh, triangles.triangles, start);
    Point from = start.at, direction = start.direction;
    double way = 0;
    // Round a vertex in a vortex the line would never get on.
    for (std::size_t step = 0; next && way < length && step < triangles.triangles.size(); ++step) {
        const auto [a, b, last] = *next;
        const double right = cross(direction, mesh.points[a] - from), left = cross(direction, mesh.points[b] - from);
        const double share = left > right ? std::clamp(right / (right - left), 0.0, 1.0) : 0.5;
        const Point at = mesh.points[a] + share * (mesh.points[b] - mesh.points[a]);
        way += distance(from, at);
        if (last) line.push_back({a, b, share, at});
        const std::optional<std::uint32_t> t = triangles.at_edges.beside(a, b, last);
        if (!t) break;
        const Triangle& triangle = triangles.triangles[*t];
        const Point mean = mean_velocity(triangle, states);
        if (way > near && dot(mean, start.direction) > 0) direction = (1 / lamina::length(mean)) * mean;
        from = at;
        const auto third = std::find_if(std::begin(triangle.v), std::end(triangle.v), [a = a, b = b](VertexId v) {
                               return v.value != a && v.value != b;
                           })->value;
        const bool is_left = cross(direction, mesh.points[third] - from) > 0;
        next = is_left ? Crossing{a, third, t} : Crossing{third, b, t};
    }
    return line;
}

}  // namespace lamina::flow::euler
