// How high the layers asked for lie on each ray.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Returns the heights of layers 0 ... `layers`.
std::vector<double> heights_by_law(GrowthLaw law, double first_height, double growth, std::uint32_t layers);

/// Returns Ray::growth of all rays. Not for the adaptive law, where each ray has its own.
double common_growth(const LayerGrowth& growth);

/// Returns the height of the layers asked for on a wall of evenly spaced points. For laws that go by the spacing it is
/// an estimate.
double expected_height(const LayerGrowth& growth, double spacing);

/// Returns the heights of the layers asked for on each ray. Throws OptionError where layers up to isotropy would be
/// more than anybody wants.
LayerHeights make_heights(const RaySet& set, const LayerGrowth& growth);

/// Multiplies the n-th spacing, n >= 0, by stretch^n. heights[0] = 0 is the wall.
void stretch_heights(double stretch, std::span<double> heights);

/// Returns the heights with the columns of rays whose limit is below the height of all their layers stretched, so that
/// a layer ends at the limit, or next to it below where that would take more than max_stretch.
LayerHeights fit_heights(const LayerHeights& heights, std::span<const double> limits);

}  // namespace lamina::layers
