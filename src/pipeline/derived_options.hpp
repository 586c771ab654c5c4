// Options of one stage that follow from those of another.
#pragma once

#include <span>

#include <lamina/pipeline.hpp>

namespace lamina::pipeline {

/// The spacing along walls may grow by the gradation of the layer's border per unit of distance, and by this much in
/// any case: slower gradations are for the outer region alone.
inline constexpr double min_wall_gradation = 0.05;

/// Returns whether a background mesh decides on the sizes beyond the layers (SizedMesh::gradation).
inline bool decides_on_sizes(const SizingOptions& sizing) { return sizing.background && sizing.background->gradation; }

/// Returns the options of a border whose edges are to suit these sources, too.
BorderOptions border_with_sources(BorderOptions border, std::span<const SizeSource> sources);

/// Returns the sizes with edges short enough for a tunnel, where they do not say how long edges may be.
SizingOptions sizes_in_tunnel(SizingOptions sizing, const FarFieldOptions& far_field, double chord, double fineness);

}  // namespace lamina::pipeline
