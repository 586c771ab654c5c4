// Rays between two others on the edge between their origins.
#pragma once

#include <vector>

#include "layers/stages.hpp"

namespace lamina::layers {

/// Makes rays between two neighbours. Their origins divide the edge between the origins of the two; their directions
/// turn evenly from the one to the other. Precondition: the two stand on a wall and have different origins.
class IntermediateRays {
public:
    IntermediateRays(const RayLine& first, const RayLine& last);

    /// Returns the angle from the first ray to the last one in radians, counter-clockwise.
    double angle() const { return last_angle_ - first_angle_; }

    /// Adds the ray at the share part / whole of the way, unless the edge is too short to be divided there in floating
    /// point. Precondition: rays.back() is the first of the two or the last one added.
    void add(double part, double whole, std::vector<RayLine>& rays) const;

private:
    Point from_, to_, normal_;
    double first_least_height_, last_least_height_;
    double first_angle_ = 0, last_angle_ = 0;  ///< from the normal of the edge
};

}  // namespace lamina::layers
