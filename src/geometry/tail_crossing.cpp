#include "geometry/tail_crossing.hpp"

#include <algorithm>
#include <cstddef>

#include "core/box_tree.hpp"
#include "core/segments.hpp"

namespace lamina::geometry {

namespace {

constexpr double max_tail_share = 0.02;  // of the extent

/// A crossing of two edges, by their numbers of vertices before and behind the rearmost vertex.
struct Crossing {
    std::size_t before, behind;
    Point at;
};

/// The vertices of an outline, counted from the rearmost one in both directions.
class Tail {
public:
    explicit Tail(const std::vector<SourcePoint>& points) : points_(points), reach_(max_tail_share * extent(points)) {
        const auto rearmost = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
            return lexicographically_less(a.at, b.at);
        });
        rearmost_ = static_cast<std::size_t>(rearmost - points.begin());
    }

    const SourcePoint& behind(std::size_t k) const { return points_[(rearmost_ + k) % points_.size()]; }
    const SourcePoint& before(std::size_t k) const {
        return points_[(rearmost_ + points_.size() - k) % points_.size()];
    }

    /// Returns the crossing of both surfaces that leaves the least of the outline, if there is one within reach.
    std::optional<Crossing> outermost_crossing() const {
        // Whatever lies in a tail is at most twice its length away from the rearmost vertex.
        const auto count_near = [&](const auto& vertex) {
            std::size_t count = 1;
            while (count < points_.size() / 2 && distance(vertex(count).at, points_[rearmost_].at) <= 2 * reach_)
                ++count;
            return count;
        };
        const std::size_t behind_count = count_near([&](std::size_t k) { return behind(k); }),
                          before_count = count_near([&](std::size_t k) { return before(k); });
        std::vector<Box> boxes;
        for (std::size_t k = 0; k < behind_count; ++k)
            boxes.push_back(core::bounding_box(behind(k).at, behind(k + 1).at));
        for (std::size_t k = 0; k < before_count; ++k)
            boxes.push_back(core::bounding_box(before(k).at, before(k + 1).at));
        std::optional<Crossing> best;
        core::BoxTree(std::move(boxes)).overlapping_pairs([&](std::size_t i, std::size_t j) {
            if (i >= behind_count || j < behind_count || i + (j - behind_count) == 0) return;
            const std::size_t k = j - behind_count;
            if (best && std::pair{best->before + best->behind, best->before} >= std::pair{k + i, k}) return;
            if (const std::optional<Crossing> found = crossing(k, i)) best = found;
        });
        return best;
    }

    /// Returns the largest distance of the vertices of a tail from the crossing behind which it begins.
    double length(const Crossing& crossing) const {
        double length = 0;
        for (std::size_t k = 0; k <= crossing.behind; ++k)
            length = std::max(length, distance(behind(k).at, crossing.at));
        for (std::size_t k = 0; k <= crossing.before; ++k)
            length = std::max(length, distance(before(k).at, crossing.at));
        return length;
    }

    /// Returns the lines of the vertices of such a tail that do not lie at the crossing itself, ascending.
    std::vector<std::size_t> lines(const Crossing& crossing) const {
        std::vector<std::size_t> lines;
        const auto add = [&](const SourcePoint& p) {
            if (p.line > 0 && p.at != crossing.at) lines.push_back(p.line);
        };
        for (std::size_t k = 0; k <= crossing.behind; ++k) add(behind(k));
        for (std::size_t k = 1; k <= crossing.before; ++k) add(before(k));
        std::sort(lines.begin(), lines.end());
        return lines;
    }

private:
    const std::vector<SourcePoint>& points_;
    double reach_;
    std::size_t rearmost_ = 0;

    /// Returns the crossing of the edges that begin at these vertices, counted from the rearmost one.
    std::optional<Crossing> crossing(std::size_t k_before, std::size_t k_behind) const {
        const Point a = before(k_before).at, b = before(k_before + 1).at, c = behind(k_behind).at,
                    d = behind(k_behind + 1).at;
        if (!core::segments_meet(a, b, c, d)) return std::nullopt;
        const double denominator = cross(b - a, d - c);
        if (denominator == 0) return std::nullopt;  // they overlap: check_simple() refuses them
        const Crossing found{k_before, k_behind, a + (cross(c - a, d - c) / denominator) * (b - a)};
        if (!is_within_reach(found)) return std::nullopt;
        return found;
    }

    /// Returns whether length() is within reach. The rearmost vertex, which comes first, is mostly the farthest.
    bool is_within_reach(const Crossing& crossing) const {
        const auto is_near = [&](const SourcePoint& p) { return distance(p.at, crossing.at) <= reach_; };
        for (std::size_t k = 0; k <= crossing.behind; ++k)
            if (!is_near(behind(k))) return false;
        for (std::size_t k = 1; k <= crossing.before; ++k)
            if (!is_near(before(k))) return false;
        return true;
    }
};

}  // namespace

std::optional<TailCut> cut_crossing_tail(std::vector<SourcePoint>& points) {
    constexpr std::size_t min_vertices = 5;
    if (points.size() < min_vertices) return std::nullopt;
    const Tail tail(points);
    const std::optional<Crossing> crossing = tail.outermost_crossing();
    if (!crossing) return std::nullopt;
    const std::size_t removed = crossing->before + crossing->behind + 1;
    if (points.size() < removed + 3) return std::nullopt;

    std::vector<SourcePoint> kept{{crossing->at, 0}};
    for (std::size_t k = crossing->behind + 1; kept.size() + removed <= points.size(); ++k)
        kept.push_back(tail.behind(k));
    TailCut cut{crossing->at, false, tail.length(*crossing) / extent(points), tail.lines(*crossing)};
    // Where the surfaces meet at a vertex, the crossing is that vertex, which may be the last one cut off or the first
    // one kept.
    for (const SourcePoint& vertex : {tail.before(crossing->before), tail.behind(crossing->behind)})
        if (vertex.at == crossing->at) kept[0] = vertex;
    if (kept[1].at == kept[0].at) kept.erase(kept.begin());
    if (kept.back().at == kept[0].at) {
        kept[0] = kept.back();
        kept.pop_back();
    }
    if (kept.size() < 3) return std::nullopt;
    cut.at_vertex = kept[0].line > 0;
    points = std::move(kept);
    return cut;
}

}  // namespace lamina::geometry
