// How fast layers grow: the ratios of the heights of cells that lie one over the other.
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::page {

/// The bins of growth_histogram(): growth_bins of them, each growth_step wide, from least_growth on.
inline constexpr double least_growth = 0.8, growth_step = 0.02;
inline constexpr std::size_t growth_bins = 70;

/// Returns the number of edges between successive layers for which the height above the edge over that below lies in
/// each bin; the first and last bins take what lies beyond. Empty for a mesh without numbers of layers. Precondition:
/// all indices are in range.
std::vector<std::uint32_t> growth_histogram(const Mesh& mesh);

}  // namespace lamina::page
