// Further rays between those of a set, where numbers of layers change.
#pragma once

#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Inserts rays between neighbours whose limits allow numbers of layers that differ by more than one, one ray for each
/// layer between. As the numbers of neighbours differ by at most one, coarse walls would without these rays have few
/// layers far from where something is in the way. None is inserted where the rays would stand apart by less than two
/// heights of the last layer, nor on elements that are jagged (Rays::jagged).
RaySet insert_rays_where_counts_change(const RaySet& set, std::span<const char> jagged, const LayerHeights& heights,
                                       std::span<const double> limits);

}  // namespace lamina::layers
