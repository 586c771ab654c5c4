// The region between a layer and the near-body box, cut into strips.
//
//      box   X ----------- X ----------- X        a strip lies between two cuts; it is halved at the border vertex
//            |             |             |        nearest to its middle that offers a good cut
//            |    strip    |    strip    |
//      layer B ~~~~~~~~~~~ B ~~~~~~~~~~~ B
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/predicates.hpp"
#include "kernel/estimate.hpp"
#include "outer/separators.hpp"
#include "outer/skeleton.hpp"

namespace lamina::outer {

namespace {

/// Places on the two loops, not reduced modulo their sizes: a strip's second cut has the larger places.
struct Cut {
    std::size_t border, box;
    std::vector<VertexId> chain;  ///< from border to box
};

struct Strip {
    Cut first, second;
};

class NearBody {
public:
    NearBody(Skeleton& skeleton, std::span<const VertexId> border, std::span<const VertexId> box, const SizeField& size,
             SeparatorRule rule, double pieces_target)
        : skeleton_(skeleton), border_(border), box_(box), size_(size), rule_(rule), target_(pieces_target) {}

    void cut() {
        if (triangles_in_annulus() <= keep_whole * target_) return;
        // The first two cuts leave from the ends of the body, where the border turns most.
        const auto by_x = [&](VertexId a, VertexId b) { return lexicographically_less(point(a), point(b)); };
        const std::size_t n = border_.size();
        const std::size_t right = std::max_element(border_.begin(), border_.end(), by_x) - border_.begin();
        const std::size_t left = std::min_element(border_.begin(), border_.end(), by_x) - border_.begin();
        const Strip all{{right, 0, {}}, {right + n, box_.size(), {}}};
        std::optional<Cut> first = best_cut(all, right + n, right + n - n / 8, n / 4);
        if (!first) return;
        first->border %= n;
        Cut again{first->border + n, first->box + box_.size(), first->chain};
        const std::size_t opposite = left > first->border ? left : left + n;
        std::optional<Cut> second = best_cut({*first, again}, opposite, first->border + n / 4, n / 2);
        if (!second) return;
        skeleton_.add_chain(first->chain, true);
        skeleton_.add_chain(second->chain, true);
        halve({*first, *second});
        halve({*second, again});
    }

private:
    /// A strip of up to this multiple of the target is left whole: halves of it would be smaller than need be.
    static constexpr double keep_whole = 1.5;
    static constexpr std::size_t fewest_border_edges = 16;
    static constexpr std::size_t fewest_box_edges = 6;

    Point point(VertexId v) const { return skeleton_.points[v.index()]; }
    VertexId border_at(std::size_t i) const { return border_[i % border_.size()]; }
    VertexId box_at(std::size_t j) const { return box_[j % box_.size()]; }

    double triangles_in_annulus() const {
        std::vector<VertexId> ids(border_.rbegin(), border_.rend());
        const std::size_t split = ids.size();
        ids.insert(ids.end(), box_.begin(), box_.end());
        return triangles_in(ids, split);
    }

    /// Two loops of vertices (or one, where split == ids.size()), region on their left.
    double triangles_in(const std::vector<VertexId>& ids, std::size_t split) const {
        std::vector<Point> points;
        for (VertexId v : ids) points.push_back(point(v));
        std::vector<Segment> segments;
        for (std::size_t i = 0; i < ids.size(); ++i) {
            const std::size_t first = i < split ? 0 : split, last = i < split ? split : ids.size();
            segments.push_back({VertexId{i}, VertexId{i + 1 < last ? i + 1 : first}});
        }
        return kernel::estimate_triangles(points, segments, size_);
    }

    std::vector<VertexId> outline(const Strip& s) const {
        std::vector<VertexId> ids(s.first.chain.begin(), s.first.chain.end() - 1);
        for (std::size_t j = s.first.box; j < s.second.box; ++j) ids.push_back(box_at(j));
        ids.insert(ids.end(), s.second.chain.rbegin(), s.second.chain.rend() - 1);
        for (std::size_t i = s.second.border; i > s.first.border; --i) ids.push_back(border_at(i));
        return ids;
    }

    void halve(const Strip& strip) {
        const std::size_t edges = strip.second.border - strip.first.border;
        if (edges < 2 * fewest_border_edges) return;
        const auto ids = outline(strip);
        if (triangles_in(ids, ids.size()) <= keep_whole * target_) return;
        std::optional<Cut> middle = best_cut(strip, strip.first.border + edges / 2,
                                             strip.first.border + fewest_border_edges, edges - 2 * fewest_border_edges);
        if (!middle) return;
        skeleton_.add_chain(middle->chain, true);
        halve({strip.first, *middle});
        halve({*middle, strip.second});
    }

    /// The cut at the border vertex nearest to `wanted` among the `count` from `from` on that offers a good one; up to
    /// 64 vertices are tried.
    std::optional<Cut> best_cut(const Strip& strip, std::size_t wanted, std::size_t from, std::size_t count) {
        const std::size_t stride = std::max<std::size_t>(1, count / 64);
        std::vector<std::size_t> candidates;
        for (std::size_t i = from; i <= from + count; i += stride) candidates.push_back(i);
        candidates.push_back(wanted);
        const auto away = [&](std::size_t i) { return i > wanted ? i - wanted : wanted - i; };
        std::sort(candidates.begin(), candidates.end(),
                  [&](std::size_t a, std::size_t b) { return away(a) != away(b) ? away(a) < away(b) : a < b; });
        for (std::size_t i : candidates)
            if (std::optional<Cut> cut = try_cut(strip, i)) return cut;
        return std::nullopt;
    }

    std::optional<Cut> try_cut(const Strip& strip, std::size_t i) {
        const Point before = point(border_at(i + border_.size() - 1)), p = point(border_at(i)),
                    after = point(border_at(i + 1));
        // Out of the layer along the bisector: the border runs counter-clockwise, so its right side is outside.
        const Point outward = unit(-perpendicular(unit(after - p) + unit(p - before)));
        const std::optional<std::size_t> j = foot(strip, p, outward);
        if (!j) return std::nullopt;
        const Point q = point(box_at(*j));
        const Point box_edge = point(box_at(*j + 1)) - point(box_at(*j + box_.size() - 1));
        if (!steep(q - p, after - p, 0.5) || !steep(q - p, before - p, 0.5) || !steep(q - p, box_edge, 0.7))
            return std::nullopt;
        if (!sees(strip, i, *j)) return std::nullopt;

        const std::vector<Point> interior = separate(p, q, size_, rule_, 3);
        if (!is_decoupled(strip, i, *j, interior)) return std::nullopt;
        Cut cut{i, *j, {border_at(i)}};
        for (Point x : interior) cut.chain.push_back(skeleton_.add_point(x));
        cut.chain.push_back(box_at(*j));
        return cut;
    }

    /// |cosine| of the angle between the directions at most `cosine`, or the edge behind (a blunter angle).
    static bool steep(Point a, Point b, double cosine) {
        const double d = dot(a, b);
        return d * d <= cosine * cosine * squared_length(a) * squared_length(b);
    }

    /// The box vertex of the strip nearest to where the ray meets the box, some edges away from the strip's ends.
    std::optional<std::size_t> foot(const Strip& strip, Point p, Point direction) const {
        const bool whole = strip.first.chain.empty();
        const std::size_t margin = whole ? 0 : fewest_box_edges;
        std::optional<std::size_t> best;
        double best_offset = HUGE_VAL;
        for (std::size_t j = strip.first.box + margin; j + margin < strip.second.box + (whole ? 0 : 1); ++j) {
            const Point to = point(box_at(j)) - p;
            const double ahead = dot(to, direction);
            if (ahead <= 0) continue;
            const double offset = std::abs(cross(direction, to)) / ahead;
            if (offset < best_offset) {
                best_offset = offset;
                best = j;
            }
        }
        constexpr double largest_lean = 0.2;
        return best_offset <= largest_lean ? best : std::nullopt;
    }

    /// The straight line from border to box crosses neither border nor the strip's own cuts.
    bool sees(const Strip& strip, std::size_t i, std::size_t j) const {
        const Point p = point(border_at(i)), q = point(box_at(j));
        const auto crosses = [&](Point a, Point b) {
            return detail::inline_orient2d(p, q, a) * detail::inline_orient2d(p, q, b) <= 0 &&
                   detail::inline_orient2d(a, b, p) * detail::inline_orient2d(a, b, q) <= 0;
        };
        for (std::size_t k = strip.first.border; k < strip.second.border; ++k) {
            if (k % border_.size() == i % border_.size() || (k + 1) % border_.size() == i % border_.size()) continue;
            if (crosses(point(border_at(k)), point(border_at(k + 1)))) return false;
        }
        for (const Cut* cut : {&strip.first, &strip.second})
            if (!cut->chain.empty() && crosses(point(cut->chain.front()), point(cut->chain.back()))) return false;
        return true;
    }

    /// No vertex round the strip lies in the diametral circle of a segment of the cut, nor a vertex of the cut in that
    /// of an edge round the strip.
    bool is_decoupled(const Strip& strip, std::size_t i, std::size_t j, const std::vector<Point>& interior) const {
        std::vector<Point> line{point(border_at(i))};
        line.insert(line.end(), interior.begin(), interior.end());
        line.push_back(point(box_at(j)));
        std::vector<Point> around;
        const bool whole = strip.first.chain.empty();
        if (whole) {
            for (VertexId v : border_) around.push_back(point(v));
            around.push_back(around.front());
        } else {
            for (VertexId v : outline(strip)) around.push_back(point(v));
            around.push_back(around.front());
        }
        Box reach;
        for (Point p : line) reach.include(p);
        const double slack = 0.5 * std::max(reach.width(), reach.height());
        const Box wide{reach.lower - Point{slack, slack}, reach.upper + Point{slack, slack}};
        const auto encroaches = [](Point x, Point a, Point b) {
            return !(x == a) && !(x == b) && dot(a - x, b - x) <= 0;
        };
        for (std::size_t k = 0; k + 1 < around.size(); ++k) {
            if (!wide.contains(around[k]) && !wide.contains(around[k + 1])) continue;
            for (std::size_t l = 0; l + 1 < line.size(); ++l) {
                if (encroaches(around[k], line[l], line[l + 1])) return false;
                if (encroaches(line[l], around[k], around[k + 1])) return false;
            }
        }
        return true;
    }

    Skeleton& skeleton_;
    std::span<const VertexId> border_, box_;
    const SizeField& size_;
    SeparatorRule rule_;
    double target_;
};

}  // namespace

void cut_near_body(Skeleton& skeleton, std::span<const VertexId> border, std::span<const VertexId> box,
                   const SizeField& size, SeparatorRule rule, double pieces_target) {
    NearBody(skeleton, border, box, size, rule, pieces_target).cut();
}

}  // namespace lamina::outer
