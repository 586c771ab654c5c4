#include "geometry/growing_run.hpp"

#include <algorithm>

#include "geometry/point_runs.hpp"

namespace lamina::geometry {

void GrowingRun::grow_to(std::size_t end) {
    for (; end_ < end; ++end_) {
        const Point p = points_[end_].at;
        if (end_ > first_) {
            const double step = distance(points_[end_ - 1].at, p);
            length_ += step;
            if (step > longest_step_) {
                longest_step_ = step;
                after_longest_ = end_;
                box_before_step_ = box_;
                box_behind_step_ = {};
            }
            box_behind_step_.include(p);
        }
        box_.include(p);
    }
}

bool GrowingRun::is_loop() const {
    const PointSpan run = points();
    return run.size() >= 3 && distance(run.front().at, run.back().at) <= 0.5 * length_;
}

std::optional<std::size_t> GrowingRun::second_surface() const {
    const std::size_t second = longest_step_ < 0 ? 0 : after_longest_ - first_;
    if (second < 3 || points().size() - second < 3) return std::nullopt;
    const double size = std::max(core::longer_side(box_before_step_), core::longer_side(box_behind_step_));
    if (!are_two_surfaces(points().first(second), points().subspan(second), size)) return std::nullopt;
    return second;
}

/// Returns whether the step to point i is long and begins far from the start, for a run of this size.
bool GrowingRun::steps_back_to(std::size_t i, double size) const {
    const Point before = points_[i - 1].at;
    return distance(before, points_[first_].at) > 0.5 * size && distance(before, points_[i].at) > 0.5 * size;
}

std::optional<std::size_t> GrowingRun::return_to_start() {
    constexpr double near_share = 0.1;  // of the size
    const double size = core::longer_side(box_);
    // The size only grows: points come near the start once, and steps cease to be long once.
    for (; asked_ < end_; ++asked_)
        if (steps_back_to(asked_, size)) far_.emplace(distance(points_[asked_].at, points_[first_].at), asked_);
    for (; !far_.empty() && far_.top().first <= near_share * size; far_.pop()) near_.push(far_.top().second);
    while (!near_.empty() && !steps_back_to(near_.top(), size)) near_.pop();
    return near_.empty() ? std::nullopt : std::optional(near_.top() - first_);
}

}  // namespace lamina::geometry
