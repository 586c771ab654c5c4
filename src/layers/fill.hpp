// The cells between walls and outer borders, made with a record of the threads' times.
#pragma once

#include <lamina/layers.hpp>

#include "core/busy_times.hpp"
#include "delaunay/pieces/pieces.hpp"

namespace lamina::layers {

/// Does what fill_layer() does and adds the times of the threads to `times`, unless that is null. The kinds of work are
/// those of delaunay::pieces::PieceWork.
LAMINA_EXPORT LayerCells fill(const Layer& layer, LayerTopology topology, const DecompositionOptions& options,
                              core::BusyTimes* times);

/// Returns the constrained Delaunay triangulation of the layer's points between walls and outer borders, in pieces.
LAMINA_EXPORT delaunay::pieces::PiecewiseTriangulation triangulate_layer(const Layer& layer,
                                                                         const DecompositionOptions& options = {},
                                                                         core::BusyTimes* times = nullptr);

}  // namespace lamina::layers
