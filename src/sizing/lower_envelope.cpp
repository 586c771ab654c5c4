// evaluate() and push() both walk down the binary tree of source groups, and evaluate() looks at the nearest groups
// first.
#include "sizing/lower_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/box_tree.hpp"

namespace lamina::sizing {

namespace {

double distance(const Box& a, const Box& b) {
    const double x = std::max({a.lower.x - b.upper.x, b.lower.x - a.upper.x, 0.0});
    const double y = std::max({a.lower.y - b.upper.y, b.lower.y - a.upper.y, 0.0});
    return std::sqrt(x * x + y * y);
}

}  // namespace

double LowerEnvelope::evaluate(Point p, const Candidates& candidates, double bound) {
    double best = std::min(bound, max_size_);
    for (std::size_t i = candidates.begin; i < candidates.end; ++i) {
        std::uint32_t index = stack_[i];
        for (;;) {
            const SourceGroup& group = groups_[index];
            // Only sources nearer than this can lower the best value so far.
            const double reach = std::max((best - group.min_size) * inverse_gradation_, 0.0);
            if (group.is_single()) {
                const SourceShape& shape = shapes_[group.shape];
                const double squared = shape.squared_distance_to(p), limit = reach + shape.radius;
                if (squared < limit * limit)
                    best =
                        std::min(best, group.min_size + gradation_ * std::max(std::sqrt(squared) - shape.radius, 0.0));
            } else if (core::squared_distance(group.box, p) < reach * reach) {
                std::uint32_t near = index + 1, far = group.right;
                if (core::squared_distance(groups_[far].box, p) < core::squared_distance(groups_[near].box, p))
                    std::swap(near, far);
                pending_.push_back(far);
                index = near;
                continue;
            }
            if (pending_.empty()) break;
            index = pending_.back();
            pending_.pop_back();
        }
    }
    return best;
}

Candidates LowerEnvelope::push(const Box& cell, double side, double max_value, const Candidates& parent) {
    constexpr double sqrt_half = 0.70710678118654752;
    const double radius = sqrt_half * side;
    Candidates result{stack_.size(), 0, HUGE_VAL};
    double lowest = HUGE_VAL, covering = HUGE_VAL;
    for (std::size_t i = parent.begin; i < parent.end; ++i) {
        std::uint32_t index = stack_[i];
        for (;;) {
            const SourceGroup& group = groups_[index];
            double apart = distance(group.box, cell);
            double min_value = group.min_size + gradation_ * apart;
            if (group.is_single() && min_value <= max_value) {
                apart = std::max(apart, shapes_[group.shape].distance_to(cell.center()) - radius);
                min_value = group.min_size + gradation_ * apart;
            }
            if (min_value <= max_value && !group.is_single() && group.extent() > 0.5 * side) {
                pending_.push_back(group.right);
                ++index;
                continue;
            }
            if (min_value <= max_value) {
                if (group.is_single() && apart <= 0 && group.min_size < covering && shapes_[group.shape].covers(cell))
                    covering = group.min_size;
                stack_.push_back(index);
                result.nearest = std::min(result.nearest, apart);
                if (min_value < lowest) {
                    // evaluate() looks at this group first and then skips most others.
                    lowest = min_value;
                    std::swap(stack_[result.begin], stack_.back());
                }
            }
            if (pending_.empty()) break;
            index = pending_.back();
            pending_.pop_back();
        }
    }
    result.end = stack_.size();
    result.constant = covering <= lowest;
    return result;
}

}  // namespace lamina::sizing
