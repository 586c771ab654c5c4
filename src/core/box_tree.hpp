// Bounding boxes of an ordered sequence of items, in a tree of fixed arity: finds what overlaps a box, or the least of
// (value + slope x distance). Items that follow each other along a curve lie close together, so groups of consecutive
// items make tight boxes and no sorting is needed; unlike a uniform grid it does not care about graded spacing.
// Source: bounding volume hierarchies, e.g. C. Ericson, Real-Time Collision Detection (2005), chapter 6.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::core {

inline double squared_distance(const Box& box, Point p) {
    const double dx = std::max({box.lower.x - p.x, 0.0, p.x - box.upper.x});
    const double dy = std::max({box.lower.y - p.y, 0.0, p.y - box.upper.y});
    return dx * dx + dy * dy;
}

class BoxTree {
public:
    explicit BoxTree(std::vector<Box> items) {
        levels_.push_back(std::move(items));
        while (levels_.back().size() > arity) {
            const std::vector<Box>& below = levels_.back();
            std::vector<Box> level((below.size() + arity - 1) / arity);
            for (std::size_t i = 0; i < below.size(); ++i) {
                level[i / arity].include(below[i].lower);
                level[i / arity].include(below[i].upper);
            }
            levels_.push_back(std::move(level));
        }
    }

    /// Calls visit(item) for each item whose box overlaps the query.
    template <class Visit>
    void overlaps(const Box& query, Visit&& visit) const {
        walk([&](const Box& box, std::size_t, std::size_t) { return box.overlaps(query); }, visit);
    }

    /// Least value of each group of items on every level, for minimum().
    std::vector<std::vector<double>> group_minima(std::vector<double> values) const {
        std::vector<std::vector<double>> least{std::move(values)};
        for (std::size_t level = 1; level < levels_.size(); ++level) {
            std::vector<double> up(levels_[level].size(), HUGE_VAL);
            for (std::size_t i = 0; i < least.back().size(); ++i)
                up[i / arity] = std::min(up[i / arity], least.back()[i]);
            least.push_back(std::move(up));
        }
        return least;
    }

    /// min(start, min over items of value + slope x distance(item, p)); `exact(item)` gives the distance to an item.
    template <class Distance>
    double minimum(Point p, double slope, double start, const std::vector<std::vector<double>>& values,
                 Distance&& exact) const {
        double best = start;
        walk(
            [&](const Box& box, std::size_t level, std::size_t i) {
                const double room = best - values[level][i];
                return room > 0 && slope * slope * squared_distance(box, p) < room * room;
            },
            [&](std::size_t item) { best = std::min(best, values[0][item] + slope * exact(item)); });
        return best;
    }

private:
    static constexpr std::size_t arity = 4;
    std::vector<std::vector<Box>> levels_;  ///< items first, the coarsest groups (at most `arity`) last

    template <class Enter, class Visit>
    void walk(Enter&& enter, Visit&& visit) const {
        struct Group {
            std::size_t level, index;
        };
        // Depth at most 16 for 2^32 items; each level leaves at most arity - 1 siblings waiting.
        std::array<Group, 16 * arity> stack;
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
};

}  // namespace lamina::core
