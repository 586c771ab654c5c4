// Chains of edges, and the far field as a chain.
#include "decoupling/skeleton.hpp"

namespace lamina::decoupling {

void Skeleton::add_chain(std::span<const VertexId> chain, bool both_directions) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        edges.push_back({chain[i], chain[i + 1]});
        if (both_directions) edges.push_back({chain[i + 1], chain[i]});
    }
}

std::vector<Segment> chain_edges(std::span<const VertexId> chain) {
    std::vector<Segment> edges;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) edges.push_back({chain[i], chain[i + 1]});
    return edges;
}

std::vector<Segment> add_far_field_outline(Skeleton& skeleton, const FarField& far_field,
                                           const SeparatorSpacing& spacing) {
    constexpr std::size_t min_segments_of_side = 3, min_segments_of_circle = 16;
    std::vector<VertexId> loop;
    if (far_field.shape == FarFieldShape::circle) {
        for (const Point p : divide_circle(far_field.center, far_field.radius, spacing.size, min_segments_of_circle))
            loop.push_back(skeleton.add_point(p));
    } else {
        for (std::size_t i = 0; i < far_field.outline.size(); ++i) {
            const Point u = far_field.outline[i], v = far_field.outline[(i + 1) % far_field.outline.size()];
            loop.push_back(skeleton.add_point(u));
            for (const Point p : divide_separator(u, v, spacing, min_segments_of_side))
                loop.push_back(skeleton.add_point(p));
        }
    }
    loop.push_back(loop.front());
    skeleton.add_chain(loop, false);
    return chain_edges(loop);
}

}  // namespace lamina::decoupling
