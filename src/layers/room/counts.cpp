// Numbers of layers, lowered where fronts or cells would overlap.
//
// The strip between wall and front is the image of a ring. Where every cell between neighbouring rays is positively
// oriented, the image overlaps itself only if one of its two boundaries crosses itself or the other one. So it is
// enough to test cells and boundaries; pairs of cells need no test. Lowering only ever removes layers, and a layer
// without any height is the wall itself, so the loop ends.
#include "layers/room/counts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/angles.hpp"
#include "core/box_tree.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "layers/layer.hpp"
#include "layers/layered_rays.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// Where fronts meet, a ray loses one in this many of its layers at a time, and one more.
constexpr std::uint32_t lowering_divisor = 8;

/// A corner of a front: the tip of one ray, or of several rays of a fan without layers.
struct FrontTip {
    Point at;
    std::size_t first_ray, last_ray;
};

/// An edge of a front.
struct TipEdge {
    const FrontTip *a, *b;
    std::size_t next;  ///< index of the edge that follows
};

/// Lowers the numbers of layers of all rays until nothing overlaps.
class CountLowering {
public:
    CountLowering(const RaySet& set, const LayerHeights& heights, std::vector<std::uint32_t> counts)
        : set_(set), counts_(std::move(counts)), rays_{set, heights, counts_}, neighbours_(set) {}
    CountLowering(const CountLowering&) = delete;
    CountLowering& operator=(const CountLowering&) = delete;

    std::vector<std::uint32_t> run() && {
        do {
            lower_locally();
        } while (lower_where_fronts_meet() || lower_round_other_elements());
        return std::move(counts_);
    }

private:
    const RaySet& set_;
    std::vector<std::uint32_t> counts_;
    LayeredRays rays_;  ///< a view of counts_
    RayNeighbours neighbours_;

    std::size_t next(std::size_t ray) const { return neighbours_.next[ray]; }
    std::size_t previous(std::size_t ray) const { return neighbours_.previous[ray]; }
    Point origin(std::size_t ray) const { return set_.lines[ray].origin; }

    /// Lowers the number of layers to `count` at most. Returns whether it changed.
    bool lower_to(std::size_t ray, std::uint32_t count) {
        if (counts_[ray] <= count) return false;
        counts_[ray] = count;
        return true;
    }
    /// Removes one in lowering_divisor of a ray's layers, and one more. Returns whether it had any.
    bool lower_by_share(std::size_t ray) {
        return lower_to(ray, counts_[ray] - std::min(counts_[ray], 1 + counts_[ray] / lowering_divisor));
    }
    bool lower_by_share(const FrontTip& tip) {
        bool changed = false;
        for (std::size_t i = tip.first_ray;; i = next(i)) {
            changed |= lower_by_share(i);
            if (i == tip.last_ray) return changed;
        }
    }

    void lower_locally() {
        do {
            limit_count_differences(set_, counts_);
        } while (lower_bad_cells());
    }

    /// Returns whether all cells between two neighbouring rays are positively oriented. They are where, in each layer,
    /// both rays cross the chord between their two points outwards. The test is linear in the height, so the wall and
    /// the highest layer that the two have in common stand for all layers. Rays that are shifted are bent.
    bool cell_is_sound(std::size_t i, std::size_t j) const {
        const std::uint32_t common = std::min(counts_[i], counts_[j]);
        const Point a = origin(i), b = origin(j);
        if (common == 0) {
            if (counts_[i] == counts_[j] || a == b) return true;
            return orient2d(a, counts_[i] > 0 ? rays_.tip(i) : rays_.tip(j), b) > 0;
        }
        if (set_.lines[i].shift == Point{} && set_.lines[j].shift == Point{}) return is_sound_between(i, j, 0, common);
        for (std::uint32_t n = 0; n < common; ++n)
            if (!is_sound_between(i, j, n, n + 1)) return false;
        if (counts_[i] == counts_[j]) return true;
        const Point left = rays_.point(i, common), right = rays_.point(j, common);
        return orient2d(left, counts_[i] > common ? rays_.tip(i) : rays_.tip(j), right) > 0;
    }

    /// Returns the same of the cells between two layers, `low` and `high`, between which both rays are straight.
    bool is_sound_between(std::size_t i, std::size_t j, std::uint32_t low, std::uint32_t high) const {
        const Point a = rays_.point(i, low), a_top = rays_.point(i, high);
        const Point b = rays_.point(j, low), b_top = rays_.point(j, high);
        if (orient2d(a, a_top, b_top) <= 0 || orient2d(b, b_top, a_top) >= 0) return false;
        return a == b || (orient2d(a, a_top, b) > 0 && orient2d(b, b_top, a) < 0);
    }

    bool lower_bad_cells() {
        bool changed = false;
        for (std::size_t i = 0; i < set_.lines.size(); ++i) {
            const std::size_t j = next(i);
            while (!cell_is_sound(i, j)) {
                // The higher ray is lowered, or both are. Each time the pair comes closer to having no layers, which is
                // always sound.
                const std::uint32_t target = std::max(counts_[i], counts_[j]) - 1;
                lower_to(i, target);
                lower_to(j, target);
                changed = true;
            }
        }
        return changed;
    }

    /// Returns the corners of one element's front.
    std::vector<FrontTip> front_of(std::size_t element) const {
        std::vector<FrontTip> tips;
        for (std::size_t i = set_.begin[element]; i < set_.begin[element + 1]; ++i) {
            const Point at = rays_.tip(i);
            if (!tips.empty() && tips.back().at == at) {
                tips.back().last_ray = i;
            } else {
                tips.push_back({at, i, i});
            }
        }
        if (tips.size() > 1 && tips.back().at == tips.front().at) {
            tips.front().first_ray = tips.back().first_ray;
            tips.pop_back();
        }
        return tips;
    }

    /// Returns whether the front, where it touches the wall at a ray without layers, stays outside of the wall there.
    bool leaves_wall_outward(const FrontTip& before, const FrontTip& tip, const FrontTip& after) const {
        std::size_t ray_before = previous(tip.first_ray), ray_after = next(tip.last_ray);
        while (origin(ray_before) == tip.at) ray_before = previous(ray_before);  // other rays of a fan
        while (origin(ray_after) == tip.at) ray_after = next(ray_after);
        const Point wall_before = origin(ray_before), wall_after = origin(ray_after);
        const bool arrives_on_wall = before.at == wall_before, leaves_on_wall = after.at == wall_after;
        if (!arrives_on_wall && !core::inside_wedge(tip.at, wall_before, wall_after, before.at)) return false;
        if (!leaves_on_wall && !core::inside_wedge(tip.at, wall_before, wall_after, after.at)) return false;
        if (arrives_on_wall || leaves_on_wall) return true;
        return core::inside_wedge(tip.at, wall_before, after.at, before.at);
    }

    /// Adds the edges of a front to `edges`, and to `meeting` the corners round which it folds back or enters the wall.
    void add_edges(const std::vector<FrontTip>& front, std::vector<TipEdge>& edges,
                   std::vector<const FrontTip*>& meeting) const {
        const std::size_t first = edges.size(), n = front.size();
        for (std::size_t k = 0; k < n; ++k) {
            const FrontTip &before = front[(k + n - 1) % n], &tip = front[k], &after = front[(k + 1) % n];
            edges.push_back({&tip, &after, first + (k + 1) % n});
            const bool on_wall = counts_[tip.first_ray] == 0;
            if (core::segments_fold(tip.at, before.at, after.at) ||
                (on_wall && !leaves_wall_outward(before, tip, after)))
                meeting.insert(meeting.end(), {&before, &tip, &after});
        }
    }

    /// Adds to `meeting` the ends of edges of fronts that meet other edges or a wall.
    void add_meeting_edges(const std::vector<TipEdge>& edges, std::vector<const FrontTip*>& meeting) const {
        std::vector<Box> edge_boxes(edges.size()), wall_boxes(set_.lines.size());
        for (std::size_t i = 0; i < edges.size(); ++i)
            edge_boxes[i] = core::bounding_box(edges[i].a->at, edges[i].b->at);
        for (std::size_t i = 0; i < set_.lines.size(); ++i)
            wall_boxes[i] = core::bounding_box(origin(i), origin(next(i)));
        const core::BoxTree edge_tree(edge_boxes), wall_tree(std::move(wall_boxes));
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const TipEdge& edge = edges[i];
            const Point a = edge.a->at, b = edge.b->at;
            const bool on_wall = counts_[edge.a->last_ray] == 0 && counts_[edge.b->first_ray] == 0;
            if (on_wall) continue;
            edge_tree.overlaps(edge_boxes[i], [&](std::size_t j) {
                const TipEdge& other = edges[j];
                if (j == i || j == edge.next || other.next == i) return;
                if (core::segments_meet(a, b, other.a->at, other.b->at))
                    meeting.insert(meeting.end(), {edge.a, edge.b, other.a, other.b});
            });
            wall_tree.overlaps(edge_boxes[i], [&](std::size_t j) {
                const Point p = origin(j), q = origin(next(j));
                // leaves_wall_outward() has tested the walls that share a vertex with the edge.
                if (p == q || p == a || p == b || q == a || q == b) return;
                if (core::segments_meet(a, b, p, q)) meeting.insert(meeting.end(), {edge.a, edge.b});
            });
        }
    }

    /// Lowers the rays at places where fronts meet each other or a wall.
    bool lower_where_fronts_meet() {
        std::vector<std::vector<FrontTip>> fronts;
        for (std::size_t e = 0; e < set_.elements(); ++e) fronts.push_back(front_of(e));
        std::vector<TipEdge> edges;
        std::vector<const FrontTip*> meeting;
        for (const std::vector<FrontTip>& front : fronts) add_edges(front, edges, meeting);
        add_meeting_edges(edges, meeting);
        std::sort(meeting.begin(), meeting.end());
        meeting.erase(std::unique(meeting.begin(), meeting.end()), meeting.end());
        bool changed = false;
        for (const FrontTip* tip : meeting) changed |= lower_by_share(*tip);
        return changed;
    }

    /// Lowers rays round other elements. An element that lies between two rays of another one crosses no front, so the
    /// first vertex of each is sought in the cells.
    bool lower_round_other_elements() {
        if (set_.elements() < 2) return false;
        bool changed = false;
        std::vector<Box> boxes(set_.lines.size());
        for (std::size_t i = 0; i < set_.lines.size(); ++i) {
            boxes[i] = core::bounding_box(origin(i), rays_.tip(i));
            boxes[i].include(origin(next(i)));
            boxes[i].include(rays_.tip(next(i)));
        }
        const core::BoxTree tree(std::move(boxes));
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            const Point p = origin(set_.begin[e]);
            Box query;
            query.include(p);
            tree.overlaps(query, [&](std::size_t i) {
                if (i >= set_.begin[e] && i < set_.begin[e + 1]) return;
                if (!between_rays(i, next(i), p)) return;
                changed |= lower_by_share(i);
                changed |= lower_by_share(next(i));
            });
        }
        return changed;
    }

    /// Returns whether p lies between two neighbouring rays, below the front. Both rays leave the wall and the front on
    /// their own sides, so that the strip between them is convex.
    bool between_rays(std::size_t i, std::size_t j, Point p) const {
        const Point a = origin(i), b = origin(j);
        return orient2d(a, rays_.tip(i), p) >= 0 && orient2d(rays_.tip(i), rays_.tip(j), p) >= 0 &&
               orient2d(rays_.tip(j), b, p) >= 0 && orient2d(b, a, p) >= 0;
    }
};

}  // namespace

std::vector<std::uint32_t> layer_counts(const RaySet& set, const LayerHeights& heights,
                                        std::vector<std::uint32_t> counts) {
    return CountLowering(set, heights, std::move(counts)).run();
}

// Columns that are lowered once cells have been seen: where the layer leaves no room for good triangles beyond it, and
// below cells with large angles.

std::vector<std::size_t> shorten_rays(std::span<const Circle> places, Rays& rays) {
    constexpr double kept_share = 0.5;  // of the height
    std::vector<Box> boxes;
    boxes.reserve(places.size());
    for (const Circle& place : places) {
        const Point reach{place.radius, place.radius};
        boxes.push_back({place.middle - reach, place.middle + reach});
    }
    const core::BoxTree tree(std::move(boxes));
    const LayeredRays layered = layered_rays(rays);
    std::vector<std::size_t> ends(places.size(), 0), shortened;
    for (std::size_t i = 0; i < rays.set.lines.size(); ++i) {
        if (rays.counts[i] == 0) continue;
        const Point tip = layered.tip(i);
        Box at_tip;
        at_tip.include(tip);
        bool near = false;
        tree.overlaps(at_tip, [&](std::size_t k) {
            if (distance(places[k].middle, tip) > places[k].radius) return;
            near = true;
            ++ends[k];
        });
        if (near) shortened.push_back(i);
    }
    if (shortened.empty()) return ends;
    for (const std::size_t i : shortened)
        rays.limits[i] = std::min(rays.limits[i], kept_share * rays.heights.of(i)[rays.counts[i]]);
    // A wake without layers on either side would be no part of the layer.
    for (std::size_t i = 0; i < rays.limits.size(); ++i)
        if (rays.set.lines[i].place == RayPlace::wake) rays.limits[i] = std::max(rays.limits[i], rays.heights.of(i)[1]);
    fit_and_count_layers(rays);
    return ends;
}

// Cells with large angles, and columns that end below them. Such cells stand where the border divides the tops of flat
// cells, where rows rise steeply towards a wider column, and in clefts of ice.

namespace {

/// Returns whether the angle at `corner` exceeds an obtuse one with this cosine.
bool exceeds(double cosine, Point before, Point corner, Point after) {
    const Point u = before - corner, v = after - corner;
    const double d = dot(u, v);
    return d < 0 && d * d > cosine * cosine * squared_length(u) * squared_length(v);
}

/// Adds the cells of one kind.
template <class Cell>
void add_obtuse(const Layer& layer, std::span<const Cell> cells, std::span<const std::uint16_t> layers,
                std::span<const std::uint32_t> columns, double cosine, std::vector<ObtuseCell>& found) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& v = cells[i].v;
        const auto at = [&](std::size_t k) { return layer.points[v[k % std::size(v)].index()]; };
        for (std::size_t k = 0; k < std::size(v); ++k) {
            if (!exceeds(cosine, at(k), at(k + 1), at(k + 2))) continue;
            found.push_back({columns[i], layers[i]});
            break;
        }
    }
}

/// Returns, for each column, whether one of its rays is so near to the walls on both sides that no cell of the column
/// can do without such an angle: it is the one ray of a concave corner whose sides meet at twice what is left to 180
/// degrees, or less.
std::vector<char> columns_of_sharp_corners(const Layer& layer, double cosine) {
    std::vector<char> result;
    for (const std::vector<Ray>& rays : layer.rays) {
        const std::size_t n = rays.size();
        const auto origin = [&](std::size_t i) { return layer.points[rays[i % n].origin.index()]; };
        const auto is_near = [&](std::size_t ray, Point edge) {
            return dot(rays[ray].direction, edge) > -cosine * length(edge);
        };
        std::vector<char> sharp(n);
        for (std::size_t i = 0; i < n; ++i)
            sharp[i] = is_near(i, origin(i + 1) - origin(i)) && is_near(i, origin(i + n - 1) - origin(i));
        for (std::size_t i = 0; i < n; ++i) result.push_back(sharp[i] || sharp[(i + 1) % n]);
    }
    return result;
}

}  // namespace

std::vector<ObtuseCell> obtuse_cells(const Layer& layer, const LayerCells& cells, double max_angle_deg) {
    std::vector<ObtuseCell> found;
    const double cosine = core::cos_reproducible(core::radians(max_angle_deg));
    if (!cells.triangle_column.empty())
        add_obtuse<Triangle>(layer, cells.triangles, cells.triangle_layer, cells.triangle_column, cosine, found);
    if (!cells.quad_column.empty())
        add_obtuse<Quad>(layer, cells.quads, cells.quad_layer, cells.quad_column, cosine, found);
    if (found.empty()) return found;
    const std::vector<char> excused = columns_of_sharp_corners(layer, cosine);
    std::erase_if(found,
                  [&](const ObtuseCell& cell) { return cell.column == LayerCells::no_column || excused[cell.column]; });
    return found;
}

bool end_columns_below(std::span<const ObtuseCell> cells, Rays& rays) {
    const std::vector<std::size_t> next = rays.set.following();
    std::vector<std::size_t> in_domain;  // columns are counted there alone
    for (std::size_t e = 0; e < rays.set.elements(); ++e)
        for (std::size_t i = rays.set.begin[e]; i < rays.domain_end(e); ++i) in_domain.push_back(i);
    bool changed = false;
    for (const ObtuseCell& cell : cells) {
        if (cell.layer < 2) continue;
        const std::size_t first = in_domain[cell.column];
        for (const std::size_t ray : {first, next[first]}) {
            if (rays.counts[ray] < cell.layer) continue;
            rays.limits[ray] = std::min(rays.limits[ray], rays.heights.of(ray)[cell.layer - 1u]);
            changed = true;
        }
    }
    if (!changed) return false;
    fit_and_count_layers(rays);
    return true;
}

}  // namespace lamina::layers
