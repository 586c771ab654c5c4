// The cells between walls and outer borders, with the times of the threads that make them.
#pragma once

#include <lamina/layers.hpp>

#include "core/busy_times.hpp"
#include "delaunay/pieces/pieces.hpp"

namespace lamina::layers {

/// fill_layer(); the threads' times count as delaunay::pieces::Work.
LAMINA_EXPORT LayerCells fill(const Layer& layer, LayerTopology topology, const DecompositionOptions& options,
                              core::BusyTimes* times);

/// Returns the constrained Delaunay triangles of the layer's points between walls and outer borders, in pieces.
LAMINA_EXPORT delaunay::pieces::PiecewiseTriangulation triangulate_layer(const Layer& layer,
                                                                         const DecompositionOptions& options = {},
                                                                         core::BusyTimes* times = nullptr);

}  // namespace lamina::layers
