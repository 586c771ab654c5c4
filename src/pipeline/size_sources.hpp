// What asks for sizes in the outer region: borders of layers, wakes, the user's own sources.
#pragma once

#include <vector>

#include <lamina/pipeline.hpp>

namespace lamina {

/// Growth of the edges of the layers' outer borders per unit of distance: what the size field's lets them.
double border_gradation(const CaseOptions& options);

/// Spacings along walls follow those of the layer's border, but grow at least so fast: very slow gradations are for the
/// outer region alone.
inline constexpr double slowest_wall_gradation = 0.05;

/// The layer with an outer border fit to be frozen for refinement to the angle and sizes asked for, and the sources
/// that are not its border: those of the options, the wakes and the background mesh.
struct SizedLayer {
    Layer layer;
    std::vector<SizeSource> sources;
};
SizedLayer make_sized_layer(const Pslg& pslg, const CaseOptions& options, const Box& domain);

/// The lines along wakes whose size at the trailing edge is given.
std::vector<SizeSource> wake_sources(const Pslg& pslg, const CaseOptions& options);

/// h(x) from the layers' borders and the sources.
SizeField make_size_field(const SizedLayer& layer, const CaseOptions& options, const Box& domain);

}  // namespace lamina
