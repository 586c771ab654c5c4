// Exact tests of the parts of divided edges against each other and against the walls.
#include "layers/undo_crossings.hpp"

#include "core/box_tree.hpp"
#include "core/segments.hpp"

namespace lamina::layers {

namespace {

/// A part of a divided edge.
struct EdgePart {
    Point a, b;
    std::size_t edge;  ///< index of the edge
};

std::vector<EdgePart> parts_of(std::span<const PolygonEdge> edges, const std::vector<std::vector<Point>>& points) {
    std::vector<EdgePart> parts;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        Point from = edges[i].a;
        for (Point p : points[i]) {
            parts.push_back({from, p, i});
            from = p;
        }
        parts.push_back({from, edges[i].b, i});
    }
    return parts;
}

/// Returns whether a part and the segment p-q meet in more than a common end.
bool in_conflict(const EdgePart& part, Point p, Point q) {
    if (part.a == q) return core::segments_fold(q, p, part.b);
    if (part.b == p) return core::segments_fold(p, part.a, q);
    if (part.a == p) return core::segments_fold(p, part.b, q);
    if (part.b == q) return core::segments_fold(q, part.a, p);
    return core::segments_meet(part.a, part.b, p, q);
}

/// Returns the edges that have a part in conflict with a wall or with a part of another edge. May list an edge twice.
std::vector<std::size_t> edges_in_conflict(std::span<const PolygonEdge> edges, std::span<const EdgePart> parts,
                                           std::span<const PolygonEdge> walls, const core::BoxTree& wall_tree) {
    std::vector<std::size_t> found;
    const core::BoxTree part_tree = segment_tree(parts);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const EdgePart& part = parts[k];
        const Box box = core::bounding_box(part.a, part.b);
        part_tree.overlaps(box, [&](std::size_t other) {
            if (other <= k || !in_conflict(part, parts[other].a, parts[other].b)) return;
            found.insert(found.end(), {part.edge, parts[other].edge});
        });
        wall_tree.overlaps(box, [&](std::size_t w) {
            const bool is_wall_edge = edges[part.edge].a == walls[w].a && edges[part.edge].b == walls[w].b;
            if (!is_wall_edge && in_conflict(part, walls[w].a, walls[w].b)) found.push_back(part.edge);
        });
    }
    return found;
}

}  // namespace

void undo_crossings(std::span<const PolygonEdge> edges, std::span<const PolygonEdge> walls,
                    std::vector<std::vector<Point>>& points) {
    const core::BoxTree wall_tree = segment_tree(walls);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t edge : edges_in_conflict(edges, parts_of(edges, points), walls, wall_tree)) {
            changed |= !points[edge].empty();
            points[edge].clear();
        }
    }
}

}  // namespace lamina::layers
