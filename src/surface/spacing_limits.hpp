// The stage "prepare" for walls that layers grow over.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/surface.hpp>

#include "geometry/wall_spacing.hpp"
#include "surface/curved_edge.hpp"

namespace lamina::surface {

/// Limits on the spacing of a wall that come from the layer over it. They hold beside the options of the surface; the
/// stricter limit wins.
struct SpacingLimits {
    double max_turning_deg = HUGE_VAL;  ///< as in SurfaceOptions
    double gradation = HUGE_VAL;        ///< as in SurfaceOptions
    /// Length, in units of the input, of the layer's border edges over the fan of rays at sharp corners. The spacing at
    /// sharp corners equals it, between a quarter of sharp_corner_spacing and corner_spacing.
    std::optional<double> fan_spacing{};
    std::vector<double> fan_spacings{};  ///< one per element, in place of fan_spacing; empty: no element has its own
    /// Number of equal parts of each fan. The lengths above are those over rays that are max_turning_deg apart.
    std::optional<std::uint32_t> fan_parts{};
    /// Spacings of stretches of resampled walls; they grow by the gradation beside.
    std::vector<geometry::WallSpacing> walls{};
    bool with_curves = false;  ///< whether the curves of edges are asked for
};

/// Walls, and the curves of their edges. An edge without one is straight.
struct PreparedSurfaces {
    Geometry geometry;
    std::vector<CurvedEdge> curves;
};

/// Does what prepare_within() does, and returns the curves that the walls follow (SpacingLimits::with_curves). Walls
/// are straight at sheets, and where points are kept on request without SurfaceOptions::curve_kept.
LAMINA_EXPORT PreparedSurfaces prepare_with_curves(Geometry given, const SurfaceOptions& options,
                                                   const SpacingLimits& limits, std::optional<double> chord);

/// Does what prepare_surfaces() does, within these limits. `chord` is the reference chord; empty: the extent in x.
LAMINA_EXPORT Geometry prepare_within(Geometry given, const SurfaceOptions& options, const SpacingLimits& limits,
                                      std::optional<double> chord);

}  // namespace lamina::surface
