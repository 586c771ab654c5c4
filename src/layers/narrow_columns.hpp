// Numbers of layers on columns that are narrower than their last layer is high.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/fit_heights.hpp"

namespace lamina::layers {

/// The upper end of a column.
struct ColumnEnd {
    double height;            ///< of the front, along the ray
    double last_spacing;      ///< height of the last layer with the number that is wanted
    std::uint32_t wanted;     ///< number of layers
    LayerRange layers;        ///< numbers of layers with which a stretch can keep the front where it is
    double spacing_of_least;  ///< height of the last layer with the least number
    double spacing_of_most;   ///< height of the last layer with the largest number
    bool cut;                 ///< whether layers end there because something is in the way
};

/// Changes the numbers of layers beside narrow columns, and where they would shear cells, within the ranges of their ends,
/// so that they change from ray to ray as rarely as possible. counts: the numbers that are wanted; they stay where columns
/// are wide and changes cost little.
void keep_counts_on_narrow_columns(const RaySet& set, std::span<const ColumnEnd> ends,
                                   std::vector<std::uint32_t>& counts);

}  // namespace lamina::layers
