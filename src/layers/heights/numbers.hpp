// Numbers of layers on columns of which each may have several.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layers/heights/stretch.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// The upper end of a column.
struct ColumnEnd {
    double height;         ///< of the front, along the ray
    double last_spacing;   ///< height of the last layer with the number that is wanted
    std::uint32_t wanted;  ///< number of layers
    LayerRange layers;     ///< numbers of layers with which a stretch can keep the front where it is
};

/// Returns the cheapest numbers of layers within the ranges of these ends, one per ray.
std::vector<std::uint32_t> cheapest_numbers(const RaySet& set, std::span<const ColumnEnd> ends);

}  // namespace lamina::layers
