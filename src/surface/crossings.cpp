#include "surface/crossings.hpp"

#include <utility>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/segments.hpp"

namespace lamina::surface {

std::vector<CrossingEdge> find_crossing_edges(const Geometry& geometry) {
    struct Segment {
        CrossingEdge edge;
        std::size_t next;  ///< number of the edge that follows round the outline
        Point a, b;
    };
    std::vector<Segment> segments;
    std::vector<Box> boxes;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const std::vector<Point>& p = geometry.elements[e].points;
        const std::size_t first = segments.size();
        for (std::size_t i = 0; i < p.size(); ++i) {
            const std::size_t after = (i + 1) % p.size();
            segments.push_back({{e, i}, first + after, p[i], p[after]});
            boxes.push_back(core::bounding_box(p[i], p[after]));
        }
    }
    std::vector<bool> crosses(segments.size());
    core::BoxTree(std::move(boxes)).overlapping_pairs([&](std::size_t i, std::size_t j) {
        const Segment &s = segments[i], &t = segments[j];
        const bool meet = s.next == j   ? core::segments_fold(s.b, s.a, t.b)
                          : t.next == i ? core::segments_fold(t.b, t.a, s.b)
                                        : core::segments_meet(s.a, s.b, t.a, t.b);
        if (meet) crosses[i] = crosses[j] = true;
    });
    std::vector<CrossingEdge> edges;
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (crosses[i]) edges.push_back(segments[i].edge);
    return edges;
}

}  // namespace lamina::surface
