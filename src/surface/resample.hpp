// New points on a smooth curve through the given ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <lamina/surface.hpp>

#include "surface/spline.hpp"
#include "surface/walls.hpp"

namespace lamina::surface {

/// Returns the longer side of the box round an outline.
double extent(std::span<const Point> outline);

/// Cuts a closed outline at its corners, ascending: one run from each corner to the next one, or one closed run where
/// there is no corner.
std::vector<SmoothRun> split_at_corners(std::span<const Point> outline, std::span<const std::size_t> corners);

/// What the new points are asked for.
struct Resampling {
    const SurfaceOptions& options;
    const SpacingLimits& limits;
    const Walls& walls;

    double max_turning_deg() const { return std::min(options.max_turning_deg, limits.max_turning_deg); }
};

/// Returns the element, whose number in its geometry is `index`, with new points. The corners of its outline are known
/// (Element::features); `reason` goes to the element's notes.
Element resampled(const Element& given, std::size_t index, const Resampling& how, const std::string& reason);

}  // namespace lamina::surface
