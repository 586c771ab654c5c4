// Options of one stage that follow from those of another.
#pragma once

#include <span>

#include <lamina/pipeline.hpp>

#include "layers/layer.hpp"
#include "sizing/requests.hpp"
#include "surface/spacing_limits.hpp"

namespace lamina::pipeline {

/// The spacing along walls may grow by the gradation of the layer's border per unit of distance, and by this much in
/// any case: slower gradations are for the outer region alone.
inline constexpr double min_wall_gradation = 0.05;

/// Returns whether a background mesh decides on the sizes beyond the layers (SizedMesh::gradation).
inline bool decides_on_sizes(const SizingOptions& sizing) { return sizing.background && sizing.background->gradation; }

/// Returns how fast the spacing along walls may grow: with the gradation of the layer's border, or more.
LAMINA_EXPORT double wall_gradation(const SizingOptions& sizing, double fineness);

/// Returns the limits that a layer of this growth over the walls sets on their spacing. `gradation` is
/// wall_gradation(), `order` that of the cells.
LAMINA_EXPORT surface::SpacingLimits spacing_limits(const LayerOptions& layer, const layers::LayerGrowth& growth,
                                                    double gradation, unsigned order);

/// Returns the options by which the outer border of the layer is divided to suit sizes and refinement. `chord` is the
/// reference chord.
LAMINA_EXPORT layers::BorderOptions border_options(const SizingOptions& sizing, const RefineOptions& refine,
                                                   double chord, std::span<const SizeSource> sources);

/// Returns the bodies in the form that the sizing stage takes.
sizing::SizedBodies sized_bodies(const Geometry& geometry, const ReferenceConditions& conditions);

/// Returns the options of a border whose edges are to suit these sources, too.
layers::BorderOptions border_with_sources(layers::BorderOptions border, std::span<const SizeSource> sources);

/// Returns the bodies as they are in the domain: cut at a line of symmetry, or turned to a blade of a row.
Geometry part_in_domain(Geometry geometry, const FarFieldOptions& domain, const FlowConditions& conditions);

/// Returns the sizes with the wakes that follow the angle of attack at each angle of a range (FlowConditions::alphas).
SizingOptions wakes_at_angles(SizingOptions sizing, const FlowConditions& conditions);

/// Returns the sizes with edges short enough for a tunnel or a row of blades, where they do not say how long edges may
/// be.
SizingOptions sizes_between_borders(SizingOptions sizing, const FarFieldOptions& far_field, double chord,
                                    double fineness);

}  // namespace lamina::pipeline
