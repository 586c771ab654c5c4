// The shape of a run that grows, asked for again and again: each point is looked at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "core/bounding_box.hpp"
#include "geometry/coordinate_blocks.hpp"

namespace lamina::geometry {

/// A run of points of a section.
class GrowingRun {
public:
    /// A run from point `first` on, which has no point yet. The points must outlive it.
    GrowingRun(PointSpan points, std::size_t first) : points_(points), first_(first), end_(first), asked_(first + 2) {}

    /// Lets the run end before a point that is not before its present end.
    void grow_to(std::size_t end);

    /// Returns the points of the run.
    PointSpan points() const { return points_.subspan(first_, end_ - first_); }

    /// Returns whether the run is a loop, as geometry::is_loop() does.
    bool is_loop() const;

    /// Returns where the second surface begins, as geometry::find_second_surface() does.
    std::optional<std::size_t> second_surface() const;

    /// Returns where a second surface begins in a run that steps back from the end of the first one to its start.
    std::optional<std::size_t> return_to_start();

private:
    PointSpan points_;
    std::size_t first_, end_;
    double length_ = 0;
    Box box_;
    double longest_step_ = -1;
    std::size_t after_longest_ = 0;  ///< the point behind the first of the longest steps
    Box box_before_step_, box_behind_step_;

    using Indices = std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>>;
    using Distances = std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>,
                                          std::greater<>>;
    std::size_t asked_;  ///< the points before this one are in the queues if they matter
    Distances far_;      ///< points behind long steps that are not near the start for the present size, nearest first
    Indices near_;       ///< those that were near it, and thus remain so

    bool steps_back_to(std::size_t i, double size) const;
};

}  // namespace lamina::geometry
