#include "surface/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/segments.hpp"
#include "geometry/row.hpp"

namespace lamina::surface {

namespace {

/// Walls of one element face each other where the product of their unit normals is below this.
constexpr double max_facing_product = -0.5;

/// Returns the point of a box that is farthest against a direction. Products of the direction with other points of the
/// box are no less, even when rounded.
Point farthest_against(Point direction, const Box& box) {
    return {direction.x > 0 ? box.lower.x : box.upper.x, direction.y > 0 ? box.lower.y : box.upper.y};
}

}  // namespace

ClearanceSearch::ClearanceSearch(const Geometry& geometry) {
    std::vector<Box> outlines;
    const auto add = [&](const std::vector<Point>& p) {
        ElementWalls& walls = elements_.emplace_back();
        std::vector<Box> boxes, normals;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Point a = p[i], b = p[(i + 1) % p.size()], normal = unit(-perpendicular(b - a));
            walls.edges.push_back({a, b, midpoint(a, b), normal});
            boxes.push_back(core::bounding_box(a, b));
            normals.push_back({normal, normal});
        }
        walls.tree = core::BoxTree(std::move(boxes));
        walls.normals = core::BoxTree::group_boxes(std::move(normals));
        outlines.push_back(core::bounding_box(p));
    };
    for (const Element& element : geometry.elements) add(element.points);
    for (const double shift : geometry::shifts_in_row(geometry))
        for (const Element& element : geometry.elements) add(geometry::moved(element.points, shift));
    outlines_ = core::BoxTree(std::move(outlines));
}

double ClearanceSearch::clearance(std::size_t element, Point p, Point normal, double min_own_clearance,
                                  double max_clearance) const {
    double nearest = max_clearance;
    return outlines_.min_distance(p, max_clearance, [&](std::size_t e) {
        const std::vector<WallEdge>& edges = elements_[e].edges;
        const auto distance_to = [&](std::size_t i) { return core::distance_to_segment(p, edges[i].a, edges[i].b); };
        nearest = e == element ? own_clearance(elements_[e], p, normal, min_own_clearance, nearest)
                               : elements_[e].tree.min_distance(p, nearest, distance_to);
        return nearest;
    });
}

double ClearanceSearch::own_clearance(const ElementWalls& walls, Point p, Point normal, double min_own_clearance,
                                      double nearest) {
    // Two walls of one element face each other where their normals meet. Neither the other side of the body nor the
    // wall round a corner does.
    const auto may_face_p = [&](const Box& box, std::size_t level, std::size_t i) {
        return dot(farthest_against(-normal, box) - p, normal) > 0 &&
               dot(normal, farthest_against(normal, walls.normals[level][i])) < max_facing_product;
    };
    return walls.tree.min_distance_among(p, nearest, min_own_clearance, may_face_p, [&](std::size_t i) {
        const WallEdge& edge = walls.edges[i];
        const Point towards = edge.middle - p;
        const bool faces_p =
            dot(towards, normal) > 0 && dot(towards, edge.normal) < 0 && dot(normal, edge.normal) < max_facing_product;
        return faces_p ? std::max(core::distance_to_segment(p, edge.a, edge.b), min_own_clearance) : HUGE_VAL;
    });
}

}  // namespace lamina::surface
