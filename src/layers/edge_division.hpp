// The division of one edge of a front into parts.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "layers/target_length.hpp"

namespace lamina::layers {

/// An edge with its target lengths and the number of parts that it is divided into. All parts take equal shares of the
/// integral of ds / target, so they are long where the target is large.
class EdgeDivision {
public:
    EdgeDivision() = default;
    /// target: TargetLength::along() of the edge. whole_up_to: the edge may be this many times as long as its target
    /// and still stay whole.
    EdgeDivision(double length, std::vector<TargetInterval> target, double whole_up_to = target_slack);

    /// Returns the length of the edge over the target length along it.
    double excess() const { return excess_; }

    bool divided() const { return parts_ > 1; }
    /// Returns whether there may be another part: up to six times as many parts as the target needs.
    bool extensible() const;
    void add_part() { ++parts_; }

    /// Multiplies the targets by a factor that runs linearly from `first` at the edge's start to `last` at its end.
    /// Replaces the factors of earlier calls.
    void scale_targets(double first, double last);

    /// Returns the distances of the division points from the edge's start, ascending.
    std::vector<double> division_points() const;

    /// The lengths of the parts at both ends of the edge.
    struct EndParts {
        double first, last;
    };
    EndParts end_parts() const;

    /// Returns the largest ratio of the lengths of two neighbouring parts; 1 for an edge that is not divided.
    double max_ratio() const;

private:
    double length_ = 0, excess_ = 0;
    std::vector<TargetInterval> target_;  ///< unscaled
    std::vector<TargetInterval> scaled_;
    double total_ = 0;  ///< sum of length / target over the scaled intervals
    std::size_t min_parts_ = 1, parts_ = 1;
};

}  // namespace lamina::layers
