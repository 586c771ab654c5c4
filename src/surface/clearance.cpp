#include "surface/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/segments.hpp"

namespace lamina::surface {

ClearanceSearch::ClearanceSearch(const Geometry& geometry) {
    std::vector<Box> boxes;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const std::vector<Point>& p = geometry.elements[e].points;
        for (std::size_t i = 0; i < p.size(); ++i) {
            edges_.push_back({e, p[i], p[(i + 1) % p.size()]});
            boxes.push_back(core::bounding_box(edges_.back().a, edges_.back().b));
        }
    }
    tree_ = core::BoxTree(std::move(boxes));
}

double ClearanceSearch::clearance(std::size_t element, Point p, Point normal, double min_own_clearance,
                                  double max_clearance) const {
    return tree_.min_distance(p, max_clearance, [&](std::size_t i) {
        const WallEdge& edge = edges_[i];
        const double d = core::distance_to_segment(p, edge.a, edge.b);
        if (edge.element != element) return d;
        // Two walls of one element face each other where their normals meet. Neither the other side of the body nor the
        // wall round a corner does.
        const Point towards = midpoint(edge.a, edge.b) - p, edge_normal = unit(-perpendicular(edge.b - edge.a));
        const bool faces_p =
            dot(towards, normal) > 0 && dot(towards, edge_normal) < 0 && dot(normal, edge_normal) < -0.5;
        return faces_p ? std::max(d, min_own_clearance) : HUGE_VAL;
    });
}

}  // namespace lamina::surface
