// Numbers of layers on columns that are narrower than their last layer is high.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// The upper end of a column.
struct ColumnEnd {
    double height;             ///< of the front
    double last_spacing;       ///< height of the last layer
    std::uint32_t max_layers;  ///< largest number of layers that there are heights for
};

/// Makes the numbers of layers of neighbouring rays equal where the column between is narrow, as far as a stretch of the
/// layers can keep the front where it is.
void keep_counts_on_narrow_columns(const RaySet& set, std::span<const ColumnEnd> ends,
                                   std::vector<std::uint32_t>& counts);

}  // namespace lamina::layers
