// A tree of bounding boxes over an ordered sequence of items. It finds the items whose boxes overlap a box or each
// other, and the minimum of (value + slope x distance) over the items. Consecutive items of a curve lie close together,
// so that groups of consecutive items have tight boxes: the items need no sorting and, unlike for a uniform grid, may
// be graded in any way.
// Source: bounding volume hierarchies, e.g. C. Ericson, Real-Time Collision Detection (2005), chapter 6; a tree
// searched against itself: G. Barequet et al., BOXTREE: a hierarchical representation for surfaces in 3D, Comput.
// Graph. Forum 15 (1996).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::core {

/// Returns the squared distance from a point to a box, 0 inside it.
inline double squared_distance(const Box& box, Point p) {
    const double dx = std::max({box.lower.x - p.x, 0.0, p.x - box.upper.x});
    const double dy = std::max({box.lower.y - p.y, 0.0, p.y - box.upper.y});
    return dx * dx + dy * dy;
}

/// Returns the squared distance between two boxes, 0 where they overlap.
inline double squared_distance(const Box& a, const Box& b) {
    const double dx = std::max({a.lower.x - b.upper.x, 0.0, b.lower.x - a.upper.x});
    const double dy = std::max({a.lower.y - b.upper.y, 0.0, b.lower.y - a.upper.y});
    return dx * dx + dy * dy;
}

/// The tree over the boxes of items, which are numbered by their places in the sequence.
class BoxTree {
public:
    explicit BoxTree(std::vector<Box> items) : levels_(group_boxes(std::move(items))) {}

    /// Returns the boxes of each group of items on every level, from those of the items, which come first.
    static std::vector<std::vector<Box>> group_boxes(std::vector<Box> items) {
        std::vector<std::vector<Box>> levels{std::move(items)};
        while (levels.back().size() > arity) {
            const std::vector<Box>& below = levels.back();
            std::vector<Box> level((below.size() + arity - 1) / arity);
            for (std::size_t i = 0; i < below.size(); ++i) {
                level[i / arity].include(below[i].lower);
                level[i / arity].include(below[i].upper);
            }
            levels.push_back(std::move(level));
        }
        return levels;
    }

    /// Calls visit(item) for each item whose box overlaps the query, in ascending order.
    template <class Visit>
    void overlaps(const Box& query, Visit&& visit) const {
        walk([&](const Box& box, std::size_t, std::size_t) { return box.overlaps(query); }, visit);
    }

    /// Calls visit(i, j), i < j, once for each pair of items whose boxes overlap. The order of the calls depends on the
    /// items alone: the pairs within the first half of a group of 2^k items, then those within the second half, then
    /// those across. On real outlines the number of pairs of groups that are compared is O(n), since neighbouring
    /// groups touch at one point only.
    template <class Visit>
    void overlapping_pairs(Visit&& visit) const {
        pairs_within(levels_.size() - 1, 0, visit);
    }

    /// Returns the smallest value of each group of items on every level, from the values of the items. minimum() takes
    /// the result as `values`.
    std::vector<std::vector<double>> group_minima(std::vector<double> values) const {
        std::vector<std::vector<double>> minima{std::move(values)};
        for (std::size_t level = 1; level < levels_.size(); ++level) {
            std::vector<double> above(levels_[level].size(), HUGE_VAL);
            for (std::size_t i = 0; i < minima.back().size(); ++i)
                above[i / arity] = std::min(above[i / arity], minima.back()[i]);
            minima.push_back(std::move(above));
        }
        return minima;
    }

    /// Calls visit(item), in ascending order, for each item whose value + slope x distance of its box from the query is
    /// below a limit.
    template <class Visit>
    void below(const Box& query, double slope, double limit, const std::vector<std::vector<double>>& values,
               Visit&& visit) const {
        walk(
            [&](const Box& box, std::size_t level, std::size_t i) {
                const double room = limit - values[level][i];
                return room > 0 && slope * slope * squared_distance(box, query) < room * room;
            },
            visit);
    }

    /// Returns min(start, minimum over the items of value + slope x distance to p). distance(item) returns the distance
    /// from p to an item, which may not be less than that to its box. Groups that may hold the least value are entered
    /// first, so that of a curve with like values few items are looked at, wherever on it p is.
    template <class Distance>
    double minimum(Point p, double slope, double start, const std::vector<std::vector<double>>& values,
                   Distance&& distance) const {
        struct Group {
            double bound;
            std::size_t level, index;
        };
        double best = start;
        std::array<Group, max_waiting> stack;
        std::size_t waiting = 0;
        const auto push_all = [&](std::size_t level, std::size_t first) {
            const std::size_t begin = waiting;
            for (std::size_t i = first; i < std::min(first + arity, levels_[level].size()); ++i) {
                const double bound = values[level][i] + slope * std::sqrt(squared_distance(levels_[level][i], p));
                if (bound < best) stack[waiting++] = {bound, level, i};
            }
            std::sort(stack.begin() + begin, stack.begin() + waiting,
                      [](const Group& a, const Group& b) { return a.bound > b.bound; });
        };
        push_all(levels_.size() - 1, 0);
        while (waiting > 0) {
            const Group group = stack[--waiting];
            if (group.bound >= best) continue;
            if (group.level == 0) {
                best = std::min(best, values[0][group.index] + slope * distance(group.index));
            } else {
                push_all(group.level - 1, group.index * arity);
            }
        }
        return best;
    }

    /// Returns min(start, distance from p to the nearest item). distance(item) is as for minimum().
    template <class Distance>
    double min_distance(Point p, double start, Distance&& distance) const {
        return min_distance_among(
            p, start, 0, [](const Box&, std::size_t, std::size_t) { return true; }, distance);
    }

    /// Returns the same for items that are `least` away at least. Groups of items that may_count(box, level, index)
    /// rejects are passed over: it tells of a group on a level of group_boxes(), and of its box, whether an item of it
    /// can be nearest.
    template <class MayCount, class Distance>
    double min_distance_among(Point p, double start, double least, MayCount&& may_count, Distance&& distance) const {
        double best = start;
        walk(
            [&](const Box& box, std::size_t level, std::size_t i) {
                return best > least && squared_distance(box, p) < best * best && may_count(box, level, i);
            },
            [&](std::size_t item) { best = std::min(best, distance(item)); });
        return best;
    }

private:
    static constexpr std::size_t arity = 4;
    /// The depth is at most 16 for 2^32 items; each level leaves at most arity - 1 siblings waiting.
    static constexpr std::size_t max_waiting = 16 * arity;
    std::vector<std::vector<Box>> levels_;  ///< items first, the largest groups (at most `arity`) last

    /// Calls visit(item) for the items of all groups that enter(box, level, index) lets in, in ascending order.
    template <class Enter, class Visit>
    void walk(Enter&& enter, Visit&& visit) const {
        struct Group {
            std::size_t level, index;
        };
        std::array<Group, max_waiting> stack;
        std::size_t waiting = 0;
        const auto push_all = [&](std::size_t level, std::size_t first) {
            for (std::size_t i = std::min(first + arity, levels_[level].size()); i-- > first;)
                if (enter(levels_[level][i], level, i)) stack[waiting++] = {level, i};
        };
        push_all(levels_.size() - 1, 0);
        while (waiting > 0) {
            const Group group = stack[--waiting];
            if (group.level == 0) {
                visit(group.index);
            } else {
                push_all(group.level - 1, group.index * arity);
            }
        }
    }

    /// Two children, by their numbers within their groups.
    struct ChildPair {
        std::size_t first, second;
    };

    /// Visits the overlapping pairs among the items of the children of a group, which lie on `level` from index arity x
    /// group on.
    template <class Visit>
    void pairs_within(std::size_t level, std::size_t group, Visit&& visit) const {
        // The order of a binary tree: within the first two children, within the last two, across.
        static constexpr std::array<ChildPair, 10> order{
            {{0, 0}, {1, 1}, {0, 1}, {2, 2}, {3, 3}, {2, 3}, {0, 2}, {0, 3}, {1, 2}, {1, 3}}};
        static_assert(arity == 4);
        const std::size_t first = arity * group;
        for (const ChildPair pair : order) {
            const std::size_t a = first + pair.first, b = first + pair.second;
            if (b >= levels_[level].size()) continue;
            if (a != b) {
                pairs_between(level, a, b, visit);
            } else if (level > 0) {
                pairs_within(level - 1, a, visit);
            }
        }
    }

    /// Visits the overlapping pairs of an item of group a and an item of group b, both on `level`.
    template <class Visit>
    void pairs_between(std::size_t level, std::size_t a, std::size_t b, Visit&& visit) const {
        if (!levels_[level][a].overlaps(levels_[level][b])) return;
        if (level == 0) {
            visit(a, b);
            return;
        }
        // The order of a binary tree: first half with first, first with second, second with first, second with second.
        static constexpr std::array<ChildPair, 16> order{{{0, 0},
                                                          {0, 1},
                                                          {1, 0},
                                                          {1, 1},
                                                          {0, 2},
                                                          {0, 3},
                                                          {1, 2},
                                                          {1, 3},
                                                          {2, 0},
                                                          {2, 1},
                                                          {3, 0},
                                                          {3, 1},
                                                          {2, 2},
                                                          {2, 3},
                                                          {3, 2},
                                                          {3, 3}}};
        static_assert(arity == 4);
        for (const ChildPair pair : order) {
            const std::size_t child_a = arity * a + pair.first, child_b = arity * b + pair.second;
            if (std::max(child_a, child_b) < levels_[level - 1].size())
                pairs_between(level - 1, child_a, child_b, visit);
        }
    }
};

}  // namespace lamina::core
