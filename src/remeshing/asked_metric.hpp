// The metric that is asked for, made of the one that was given.
#pragma once

#include <span>
#include <vector>

#include <lamina/remesh.hpp>

namespace lamina::remeshing {

/// Returns the metric limited in its ratios, scaled to a number of vertices and graded, in that order and as the
/// options say. Throws InputError where a tensor is no metric.
std::vector<MetricTensor> asked_metric(const MeshView& mesh, std::span<const MetricTensor> metric,
                                       const RemeshOptions& options);

}  // namespace lamina::remeshing
