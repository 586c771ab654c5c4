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
    double height;        ///< of the front
    double last_spacing;  ///< height of the last layer
    LayerRange layers;    ///< numbers of layers with which a stretch can keep the front where it is
    bool cut;             ///< whether layers end there because something is in the way
};

/// Changes the numbers of layers beside narrow columns, within the ranges of their ends, so that they change from ray to
/// ray as rarely as possible. counts: the numbers that are wanted; they stay where columns are wide.
void keep_counts_on_narrow_columns(const RaySet& set, std::span<const ColumnEnd> ends,
                                   std::vector<std::uint32_t>& counts);

}  // namespace lamina::layers
