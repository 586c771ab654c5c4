// The border between the blades of a row: one curve below a blade, and its exact copy above.
#pragma once

#include <span>
#include <vector>

#include <lamina/pipeline.hpp>

#include "decoupling/far_field.hpp"
#include "layers/layer.hpp"
#include "pipeline/outer_walls.hpp"

namespace lamina::pipeline {

/// Returns the border below a blade with these fronts of layers, from inlet to outlet: a smooth curve near the middle of
/// the channel to the copy below, which runs along x ahead and behind. Throws OptionError where layers
/// close the channel.
std::vector<Point> border_below(std::span<const std::vector<Point>> fronts, const decoupling::FarField& far_field);

/// Returns sources and all of their copies in the row that may count in the domain; outside a row the sources alone.
std::vector<SizeSource> repeated_in_row(std::vector<SizeSource> sources, const decoupling::FarField& far_field);

/// Returns closed loops and all of their copies in the row that may count in the domain.
std::vector<std::vector<Point>> repeated_in_row(std::vector<std::vector<Point>> loops,
                                                const decoupling::FarField& far_field);

/// Closes the border of a domain in a row. The border below is divided by sizes there and above, and its vertices are
/// rounded so that those above are theirs plus the pitch, exactly.
RegionBorders close_row(const layers::Layer& layer, std::span<const Point> below, const decoupling::FarField& far_field,
                        const SizeField& size);

}  // namespace lamina::pipeline
