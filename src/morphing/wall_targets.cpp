// Where the wall vertices of a mesh are on other shapes.
#include <lamina/morph.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "morphing/arc_curve.hpp"
#include "morphing/wall_edges.hpp"
#include "surface/corners.hpp"
#include "surface/smooth_run.hpp"

namespace lamina::morphing {

namespace {

/// A closed body of a mesh: places in MorphMap::walls(), counter-clockwise.
struct Body {
    std::size_t first, count;
    std::string name;  ///< of the marker of its first edge
};

std::vector<Body> closed_bodies(const MorphMap& map) {
    const WallVertices& walls = map.walls();
    const std::size_t bodies = walls.body_first.size() - 1;
    std::vector<std::size_t> edges(bodies, 0);
    for (const Segment& edge : edges_of_walls(map.reference(), walls)) {
        const auto next = std::upper_bound(walls.body_first.begin(), walls.body_first.end(), edge.a.index());
        ++edges[static_cast<std::size_t>(next - walls.body_first.begin() - 1)];
    }
    std::vector<Body> closed;
    for (std::size_t b = 0; b < bodies; ++b) {
        const std::size_t first = walls.body_first[b], count = walls.body_first[b + 1] - first;
        if (edges[b] == count) closed.push_back({first, count, map.reference().markers[walls.marker[first]].name});
    }
    return closed;
}

std::vector<Point> outline_of(const MorphMap& map, const Body& body) {
    const auto first = map.wall_points().begin() + static_cast<std::ptrdiff_t>(body.first);
    return {first, first + static_cast<std::ptrdiff_t>(body.count)};
}

void require_bodies(std::size_t in_mesh, std::size_t given) {
    if (in_mesh != given)
        throw InputError({}, fmt::format("{} bodies for the {} of the mesh: give one shape for each", given, in_mesh));
}

/// An outline that begins at a corner: the curves from each corner to the next.
struct CornerOutline {
    std::vector<std::size_t> corners;  ///< where the curves begin
    std::vector<ArcCurve> curves;

    CornerOutline(std::span<const Point> points, std::vector<std::size_t> begins) : corners(std::move(begins)) {
        for (const surface::SmoothRun& run : surface::split_at_corners(points, corners)) curves.emplace_back(run);
    }
};

/// Returns the corners; the rearmost vertex stands for them where there are none.
std::vector<std::size_t> corners_or_tail(std::span<const Point> outline) {
    std::vector<std::size_t> corners = surface::find_corners(outline);
    if (!corners.empty()) return corners;
    const auto tail = std::max_element(outline.begin(), outline.end(), [](Point a, Point b) { return a.x < b.x; });
    return {static_cast<std::size_t>(tail - outline.begin())};
}

/// Returns the corners of the shape in such an order that they are nearest to those of the body, both seen from the
/// middles of their boxes.
std::vector<std::size_t> matching_corners(std::span<const Point> body, std::span<const std::size_t> of_body,
                                          std::span<const Point> shape, std::vector<std::size_t> of_shape) {
    const Point apart = core::bounding_box(shape).center() - core::bounding_box(body).center();
    const std::size_t n = of_shape.size();
    std::size_t best = 0;
    double least = HUGE_VAL;
    for (std::size_t turn = 0; turn < n; ++turn) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i)
            sum += squared_length(shape[of_shape[(i + turn) % n]] - body[of_body[i]] - apart);
        if (sum < least) std::tie(least, best) = std::pair(sum, turn);
    }
    std::rotate(of_shape.begin(), of_shape.begin() + static_cast<std::ptrdiff_t>(best), of_shape.end());
    return of_shape;
}

/// Returns the vertices of a body on an element: in each curve they divide the arc length as they do on the body.
std::vector<Point> points_on(const Element& element, std::span<const Point> body, const std::string& name) {
    const std::vector<std::size_t> of_body = corners_or_tail(body), found = corners_or_tail(element.points);
    if (of_body.size() != found.size())
        throw InputError({.file = element.file, .element = name},
                         fmt::format("corners appear or vanish: the shape has {}, and '{}' of the mesh has {}",
                                     found.size(), name, of_body.size()));
    const std::vector<std::size_t> of_shape = matching_corners(body, of_body, element.points, found);
    // An outline that begins at its first corner has curves in the order of the corners.
    std::vector<Point> shape(element.points);
    std::rotate(shape.begin(), shape.begin() + static_cast<std::ptrdiff_t>(of_shape.front()), shape.end());
    std::vector<std::size_t> begins(of_shape.begin(), of_shape.end());
    for (std::size_t& begin : begins) begin = (begin + shape.size() - of_shape.front()) % shape.size();
    const CornerOutline from(body, of_body), onto(shape, begins);
    std::vector<Point> points(body.size());
    for (std::size_t k = 0; k < of_body.size(); ++k) {
        const std::vector<double>& arc = from.curves[k].arc_lengths();
        points[of_body[k]] = shape[begins[k]];
        for (std::size_t i = 1; i + 1 < arc.size(); ++i)
            points[(of_body[k] + i) % body.size()] =
                onto.curves[k].at(arc[i] / from.curves[k].length() * onto.curves[k].length());
    }
    return points;
}

/// Puts the points of each body at their places among those of all wall vertices.
void put(std::span<const Point> points, const Body& body, std::vector<Point>& wall) {
    std::copy(points.begin(), points.end(), wall.begin() + static_cast<std::ptrdiff_t>(body.first));
}

}  // namespace

}  // namespace lamina::morphing

namespace lamina {

using namespace morphing;

std::vector<Point> wall_points_on(const MorphMap& map, const Geometry& shape) {
    const std::vector<Body> bodies = closed_bodies(map);
    require_bodies(bodies.size(), shape.elements.size());
    std::vector<Point> wall = map.wall_points();
    for (std::size_t b = 0; b < bodies.size(); ++b)
        put(points_on(shape.elements[b], outline_of(map, bodies[b]), bodies[b].name), bodies[b], wall);
    return wall;
}

std::vector<Point> moved_wall_points(const MorphMap& map, std::span<const Transformation> changes) {
    for (const Transformation& change : changes)
        if (std::holds_alternative<FlapDeflection>(change.change))
            throw InputError({.element = change.element},
                             "a flap takes points of the wall or adds some: give the shape with its flap");
    const std::vector<Body> bodies = closed_bodies(map);
    Geometry geometry;
    for (const Body& body : bodies) {
        Element& element = geometry.elements.emplace_back();
        element.name = element.given_name = body.name;
        element.points = outline_of(map, body);
    }
    geometry = transformed(std::move(geometry), changes);
    std::vector<Point> wall = map.wall_points();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const std::vector<Point>& points = geometry.elements[b].points;
        assert(points.size() == bodies[b].count);
        put(points, bodies[b], wall);
    }
    return wall;
}

}  // namespace lamina
