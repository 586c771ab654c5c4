// The places of a mesh that have names.
#include <lamina/places.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "core/bounding_box.hpp"
#include "core/text.hpp"

namespace lamina::mesh {

namespace {

// Sides of the windows.
constexpr double walls_side = 1.2;   ///< times the larger extent of the walls
constexpr double nose_side = 0.12;   ///< times the chord of the body
constexpr double tail_side = 0.06;   ///< likewise
constexpr double slot_side = 4;      ///< times the gap
constexpr double largest_gap = 0.1;  ///< of a slot, times the extent of all walls in x

Box square_round(Point center, double side) {
    const Point half{0.5 * side, 0.5 * side};
    return {center - half, center + half};
}

/// The points of walls, wall by wall.
struct WallPoints {
    std::vector<std::vector<Point>> bodies;  ///< walls that are closed, or end on a line of symmetry
    std::vector<std::vector<Point>> open;    ///< walls with ends, as ground has
};

WallPoints points_of_walls(const Mesh& mesh) {
    Mesh walls;
    walls.points = mesh.points;
    std::vector<bool> ends_edge(mesh.points.size(), false);
    for (const Marker& marker : mesh.markers) {
        if (marker.kind == MarkerKind::symmetry)
            for (const Segment& edge : marker.edges) ends_edge[edge.a.index()] = ends_edge[edge.b.index()] = true;
        if (!may_be_wall(marker.kind)) continue;
        walls.markers.push_back({marker.name, MarkerKind::wall, marker.edges});
        for (const Segment& edge : marker.edges) ends_edge[edge.a.index()] = true;
    }
    const WallVertices found = wall_vertices(walls);
    WallPoints result;
    for (std::size_t wall = 0; wall + 1 < found.body_first.size(); ++wall) {
        const bool is_closed = ends_edge[found.vertex[found.body_first[wall]].index()];
        std::vector<Point>& points = (is_closed ? result.bodies : result.open).emplace_back();
        for (std::size_t i = found.body_first[wall]; i < found.body_first[wall + 1]; ++i)
            points.push_back(mesh.points[found.vertex[i].index()]);
    }
    if (result.bodies.empty()) std::swap(result.bodies, result.open);
    return result;
}

/// Two points, one on each of two bodies, that are nearest to each other.
struct Gap {
    Point a, b;
    double width() const { return distance(a, b); }
};

/// Returns the gap between two bodies, whose points are sorted lexicographically.
Gap gap_between(std::span<const Point> a, std::span<const Point> b) {
    Gap gap{a.front(), b.front()};
    const auto improve = [&](Point p, Point q) {
        if (distance(p, q) < gap.width()) gap = {p, q};
        return std::abs(p.x - q.x) <= gap.width();
    };
    for (const Point p : a) {
        const auto from = std::lower_bound(b.begin(), b.end(), p, lexicographically_less);
        for (auto q = from; q != b.end() && improve(p, *q);) ++q;
        for (auto q = from; q != b.begin() && improve(p, *std::prev(q));) --q;
    }
    return gap;
}

std::vector<Gap> slots_between(std::vector<std::vector<Point>> bodies, double widest) {
    for (std::vector<Point>& body : bodies) std::sort(body.begin(), body.end(), lexicographically_less);
    std::vector<Gap> slots;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t k = i + 1; k < bodies.size(); ++k)
            if (const Gap gap = gap_between(bodies[i], bodies[k]); gap.width() <= widest) slots.push_back(gap);
    std::sort(slots.begin(), slots.end(), [](const Gap& g, const Gap& h) {
        return lexicographically_less(midpoint(g.a, g.b), midpoint(h.a, h.b));
    });
    return slots;
}

/// The two ends of a body.
struct Ends {
    Point nose, tail;
    double chord() const { return distance(nose, tail); }
};

Ends ends_of(std::span<const Point> body) {
    const Point tail = *std::max_element(body.begin(), body.end(), lexicographically_less);
    const Point nose = *std::max_element(body.begin(), body.end(), [&](Point p, Point q) {
        return squared_length(p - tail) < squared_length(q - tail);
    });
    return {nose, tail};
}

}  // namespace

}  // namespace lamina::mesh

namespace lamina {

std::vector<Place> named_places(const Mesh& mesh) {
    using namespace lamina::mesh;
    std::vector<Place> places;
    const auto add = [&](std::string name, Point center, double side) {
        if (side > 0) places.push_back({std::move(name), square_round(center, side)});
    };
    if (mesh.points.empty()) return places;
    const Box all = core::bounding_box(mesh.points);
    add("all", all.center(), 1.02 * core::longer_side(all));
    auto [bodies, open] = points_of_walls(mesh);
    Box walls;
    for (const auto& body : bodies)
        for (const Point p : body) walls.include(p);
    if (bodies.empty()) return places;
    add("walls", walls.center(), walls_side * core::longer_side(walls));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Ends ends = ends_of(bodies[i]);
        add(core::concat("nose:", i + 1), ends.nose, nose_side * ends.chord());
        add(core::concat("tail:", i + 1), ends.tail, tail_side * ends.chord());
    }
    bodies.insert(bodies.end(), open.begin(), open.end());
    const std::vector<Gap> slots = slots_between(std::move(bodies), largest_gap * walls.width());
    for (std::size_t i = 0; i < slots.size(); ++i)
        add(core::concat("slot:", i + 1), midpoint(slots[i].a, slots[i].b), slot_side * slots[i].width());
    return places;
}

}  // namespace lamina
