// Layers on each ray, lowered locally until the layer is sound.
//
// The strip between wall and border is the image of a ring. Where every cell between neighbouring rays is positively
// oriented, the image overlaps itself only if a boundary crosses itself or another one; so cells and boundaries are all
// that need be tested, not all pairs of cells. Lowering only ever removes layers, and a layer of nothing is the wall
// itself: the loop ends.
#include <algorithm>

#include "core/box_tree.hpp"
#include "core/segments.hpp"
#include "layers/counts.hpp"
#include "layers/rays.hpp"

namespace lamina::layers {
namespace {

/// Fronts must stay simple when raised by this factor, which leaves room for isotropic triangles between them.
constexpr double raised = 1.25;
/// Share of the layers that a ray loses at a time where borders meet.
constexpr std::uint32_t lowering_share = 8;

/// A corner of a border: the tip of a ray, or of all rays of a fan without layers.
struct Node {
    Point at;
    std::size_t first_ray, last_ray;
};

class Front {
public:
    Front(const RaySet& set, const LayerHeights& heights, std::vector<std::uint32_t> counts)
        : set_(set), heights_(heights), counts_(std::move(counts)), next_(set.following()), previous_(next_.size()) {
        for (std::size_t i = 0; i < next_.size(); ++i) previous_[next_[i]] = i;
    }

    /// Until nothing is left to lower.
    std::vector<std::uint32_t> settle() && {
        for (double factor : {raised, 1.0}) {
            do {
                lower_locally();
            } while (lower_where_borders_meet(factor) || lower_round_other_bodies());
        }
        return std::move(counts_);
    }

private:
    const RaySet& set_;
    const LayerHeights& heights_;
    std::vector<std::uint32_t> counts_;
    std::vector<std::size_t> next_, previous_;

    Point point(std::size_t ray, std::uint32_t layer, double factor = 1) const {
        const RayLine& line = set_.lines[ray];
        return layer == 0 ? line.origin : line.origin + factor * heights_.of(ray)[layer] * line.direction;
    }
    Point tip(std::size_t ray, double factor = 1) const { return point(ray, counts_[ray], factor); }
    bool is_wall_edge(std::size_t a, std::size_t b) const { return counts_[a] == 0 && counts_[b] == 0; }

    bool lower_to(std::size_t ray, std::uint32_t count) {
        if (counts_[ray] <= count) return false;
        counts_[ray] = count;
        return true;
    }
    bool lower_by_share(const Node& node) {
        bool changed = false;
        for (std::size_t i = node.first_ray;; i = next_[i]) {
            changed |= lower_to(i, counts_[i] - std::min(counts_[i], 1 + counts_[i] / lowering_share));
            if (i == node.last_ray) return changed;
        }
    }

    void lower_locally() {
        do {
            limit_steps(set_, counts_);
        } while (open_notches() || lower_bad_cells());
    }

    /// A ray lower than a neighbour makes a notch in the border. Where the notch is sharper than 60 degrees the
    /// neighbour comes down too, which widens it.
    bool open_notches() {
        const std::vector<std::uint32_t> before = counts_;
        bool changed = false;
        for (std::size_t i = 0; i < set_.lines.size(); ++i) {
            const std::size_t left = previous_[i], right = next_[i];
            if (before[left] <= before[i] && before[right] <= before[i]) continue;
            const Point at = point(i, before[i]), a = point(left, before[left]), b = point(right, before[right]);
            if (orient2d(a, at, b) >= 0) continue;
            const Point u = a - at, v = b - at;
            const double projection = dot(u, v);
            if (projection <= 0 || 4 * projection * projection <= squared_length(u) * squared_length(v)) continue;
            changed |= lower_to(left, before[i]);
            changed |= lower_to(right, before[i]);
        }
        return changed;
    }

    /// Both rays must leave each chord between points of one layer outward. That is linear in the height: it holds for
    /// all layers if it holds for the wall and for the highest layer the two have in common.
    bool cell_is_sound(std::size_t i, std::size_t j) const {
        const std::uint32_t common = std::min(counts_[i], counts_[j]);
        const Point a = set_.lines[i].origin, b = set_.lines[j].origin;
        if (common == 0) {
            if (counts_[i] == counts_[j] || a == b) return true;
            return orient2d(a, counts_[i] > 0 ? tip(i) : tip(j), b) > 0;
        }
        const Point a_top = point(i, common), b_top = point(j, common);
        if (orient2d(a, a_top, b_top) <= 0 || orient2d(b, b_top, a_top) >= 0) return false;
        return a == b || (orient2d(a, a_top, b) > 0 && orient2d(b, b_top, a) < 0);
    }

    bool lower_bad_cells() {
        bool changed = false;
        for (std::size_t i = 0; i < set_.lines.size(); ++i) {
            const std::size_t j = next_[i];
            while (!cell_is_sound(i, j)) {
                // The higher one, or both: each step brings the pair closer to no layers, which is always sound.
                const std::uint32_t target = std::max(counts_[i], counts_[j]) - 1;
                lower_to(i, target);
                lower_to(j, target);
                changed = true;
            }
        }
        return changed;
    }

    /// Corners of one body's border. Rays of one origin without layers share a corner.
    std::vector<Node> border_of(std::size_t body, double factor) const {
        std::vector<Node> nodes;
        for (std::size_t i = set_.begin[body]; i < set_.begin[body + 1]; ++i) {
            const Point at = tip(i, factor);
            if (!nodes.empty() && nodes.back().at == at) {
                nodes.back().last_ray = i;
            } else {
                nodes.push_back({at, i, i});
            }
        }
        if (nodes.size() > 1 && nodes.back().at == nodes.front().at) {
            nodes.front().first_ray = nodes.back().first_ray;
            nodes.pop_back();
        }
        return nodes;
    }

    /// True if the border, where it touches the wall at a ray without layers, stays outside of the wall there.
    bool leaves_wall_outward(const Node& before, const Node& node, const Node& after) const {
        std::size_t p = previous_[node.first_ray], q = next_[node.last_ray];
        while (set_.lines[p].origin == node.at) p = previous_[p];  // other rays of a fan
        while (set_.lines[q].origin == node.at) q = next_[q];
        const Point wall_before = set_.lines[p].origin, wall_after = set_.lines[q].origin;
        const bool arrives_on_wall = before.at == wall_before, leaves_on_wall = after.at == wall_after;
        if (!arrives_on_wall && !core::inside_wedge(node.at, wall_before, wall_after, before.at)) return false;
        if (!leaves_on_wall && !core::inside_wedge(node.at, wall_before, wall_after, after.at)) return false;
        if (arrives_on_wall || leaves_on_wall) return true;
        return core::inside_wedge(node.at, wall_before, after.at, before.at);
    }

    bool lower_where_borders_meet(double factor) {
        struct Edge {
            const Node *a, *b;
            std::size_t next;  ///< index of the edge that follows
        };
        std::vector<std::vector<Node>> borders;
        for (std::size_t e = 0; e < set_.elements(); ++e) borders.push_back(border_of(e, factor));

        std::vector<Edge> edges;
        std::vector<const Node*> meeting;
        for (const std::vector<Node>& border : borders) {
            const std::size_t first = edges.size(), n = border.size();
            for (std::size_t k = 0; k < n; ++k) {
                const Node &before = border[(k + n - 1) % n], &node = border[k], &after = border[(k + 1) % n];
                edges.push_back({&node, &after, first + (k + 1) % n});
                const bool on_wall = counts_[node.first_ray] == 0;
                if (core::segments_fold(node.at, before.at, after.at) ||
                    (on_wall && !leaves_wall_outward(before, node, after)))
                    meeting.insert(meeting.end(), {&before, &node, &after});
            }
        }

        std::vector<Box> boxes(edges.size()), wall_boxes(set_.lines.size());
        for (std::size_t i = 0; i < edges.size(); ++i) boxes[i] = core::bounding_box(edges[i].a->at, edges[i].b->at);
        for (std::size_t i = 0; i < set_.lines.size(); ++i)
            wall_boxes[i] = core::bounding_box(set_.lines[i].origin, set_.lines[next_[i]].origin);
        const core::BoxTree tree(boxes), walls(std::move(wall_boxes));
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const auto [a, b, next] = edges[i];
            if (is_wall_edge(a->last_ray, b->first_ray)) continue;
            tree.overlaps(boxes[i], [&, a = a, b = b, next = next](std::size_t j) {
                const Edge& other = edges[j];
                if (j == i || j == next || other.next == i) return;
                if (core::segments_meet(a->at, b->at, other.a->at, other.b->at))
                    meeting.insert(meeting.end(), {a, b, other.a, other.b});
            });
            walls.overlaps(boxes[i], [&, a = a, b = b](std::size_t j) {
                const Point p = set_.lines[j].origin, q = set_.lines[next_[j]].origin;
                // What shares a wall vertex was judged by its wedge above.
                if (p == q || p == a->at || p == b->at || q == a->at || q == b->at) return;
                if (core::segments_meet(a->at, b->at, p, q)) meeting.insert(meeting.end(), {a, b});
            });
        }
        std::sort(meeting.begin(), meeting.end());
        meeting.erase(std::unique(meeting.begin(), meeting.end()), meeting.end());
        bool changed = false;
        for (const Node* node : meeting) changed |= lower_by_share(*node);
        return changed;
    }

    /// A body that lies between two rays of another one crosses no border: its vertices are sought in the cells.
    bool lower_round_other_bodies() {
        if (set_.elements() < 2) return false;
        bool changed = false;
        std::vector<Box> boxes(set_.lines.size());
        for (std::size_t i = 0; i < set_.lines.size(); ++i) {
            boxes[i] = core::bounding_box(set_.lines[i].origin, tip(i));
            boxes[i].include(set_.lines[next_[i]].origin);
            boxes[i].include(tip(next_[i]));
        }
        const core::BoxTree tree(std::move(boxes));
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            const Point p = set_.lines[set_.begin[e]].origin;
            Box query;
            query.include(p);
            tree.overlaps(query, [&](std::size_t i) {
                if (i >= set_.begin[e] && i < set_.begin[e + 1]) return;
                const std::size_t j = next_[i];
                const Point a = set_.lines[i].origin, b = set_.lines[j].origin;
                // Both rays leave the wall and the border edge on their own sides: the cell is convex.
                if (orient2d(a, tip(i), p) < 0 || orient2d(tip(i), tip(j), p) < 0 || orient2d(tip(j), b, p) < 0 ||
                    orient2d(b, a, p) < 0)
                    return;
                changed |= lower_by_share({p, i, i});
                changed |= lower_by_share({p, j, j});
            });
        }
        return changed;
    }
};

}  // namespace

std::vector<std::uint32_t> layer_counts(const RaySet& set, std::span<const double> limits,
                                        const LayerHeights& heights) {
    std::vector<std::uint32_t> counts(set.lines.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const std::span<const double> stack = heights.of(i);
        const auto fits = std::upper_bound(stack.begin(), stack.end(), limits[i]);
        counts[i] = static_cast<std::uint32_t>(fits - stack.begin()) - 1;
    }
    return Front(set, heights, std::move(counts)).settle();
}

}  // namespace lamina::layers
