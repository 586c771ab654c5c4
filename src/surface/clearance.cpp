#include "surface/walls.hpp"

#include "core/segments.hpp"

namespace lamina::surface {

Walls::Walls(const Geometry& geometry) {
    std::vector<Box> boxes;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const std::vector<Point>& p = geometry.elements[e].points;
        for (std::size_t i = 0; i < p.size(); ++i) {
            edges_.push_back({e, p[i], p[(i + 1) % p.size()]});
            boxes.push_back(core::bounding_box(edges_.back().a, edges_.back().b));
        }
    }
    tree_ = core::BoxTree(std::move(boxes));
    zeros_ = tree_.group_minima(std::vector<double>(edges_.size(), 0.0));
}

double Walls::room(std::size_t element, Point p, Point normal, double least_own, double most) const {
    return tree_.minimum(p, 1, most, zeros_, [&](std::size_t i) {
        const Edge& edge = edges_[i];
        const double d = core::distance_to_segment(p, edge.a, edge.b);
        if (edge.element != element) return d;
        // Opposite faces whose normals meet: neither the other side of the wall nor the way round a corner.
        const Point towards = midpoint(edge.a, edge.b) - p, facing = unit(-perpendicular(edge.b - edge.a));
        const bool across = dot(towards, normal) > 0 && dot(towards, facing) < 0 && dot(normal, facing) < -0.5;
        return across ? std::max(d, least_own) : HUGE_VAL;
    });
}

}  // namespace lamina::surface
