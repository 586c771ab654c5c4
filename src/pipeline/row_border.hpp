// The border between the blades of a row: one curve below a blade, and its exact copy above.
#pragma once

#include <span>
#include <vector>

#include <lamina/pipeline.hpp>

#include "decoupling/far_field.hpp"
#include "layers/layer.hpp"
#include "pipeline/outer_walls.hpp"

namespace lamina::pipeline {

/// The border between a blade and its copy below, from inlet to outlet.
struct RowBorder {
    std::vector<Point> curve;         ///< smooth, near the middle of the channel, along x ahead and behind
    std::vector<SizeSource> sources;  ///< keep its edges out of lines
};

/// Returns the border below a blade with these fronts of layers and the lines beside it. Throws OptionError where
/// layers or lines close the channel.
RowBorder border_below(std::vector<std::vector<Point>> fronts, std::span<const std::vector<Point>> lines,
                       const decoupling::FarField& far_field);

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
