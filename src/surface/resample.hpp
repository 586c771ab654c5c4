// New points on a smooth curve through the given ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include <lamina/surface.hpp>

#include "surface/clearance.hpp"

namespace lamina::surface {

/// Returns the longer side of the box round an outline.
double extent(std::span<const Point> outline);

/// The requests that the new points of all elements have to meet.
struct ResamplingRequest {
    const SurfaceOptions& options;
    const SpacingLimits& limits;
    const ClearanceSearch& walls;

    double max_turning_deg() const { return std::min(options.max_turning_deg, limits.max_turning_deg); }
};

/// Returns the element, whose number in its geometry is `index`, with new points, and adds a note that quotes `reason`.
/// Precondition: the corners of its outline are known (Element::features).
Element resample(const Element& given, std::size_t index, const ResamplingRequest& request, const std::string& reason);

}  // namespace lamina::surface
