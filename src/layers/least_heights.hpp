// Heights that columns reach at least.
#pragma once

#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/stages.hpp"
#include "layers/wake_outline.hpp"

namespace lamina::layers {

/// Sets the least heights of the vertices on the wall of an element: that of the nearest point of this closed chain,
/// linear along it. Those of wakes stay as they are.
void set_least_heights(std::span<const WallHeight> chain, std::span<RayVertex> outline);

/// Returns the least heights of all rays. The ends of a fan have those of the rays beside it, so that both sides of a
/// trailing edge keep their own.
std::vector<double> least_heights(const RaySet& set);

}  // namespace lamina::layers
