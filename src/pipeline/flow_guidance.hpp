// The flow before the mesh decides first heights, the least thickness of layers, spacings of walls, and wakes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/compressible_flow.hpp>
#include <lamina/flow.hpp>
#include <lamina/pipeline.hpp>

#include "geometry/wall_spacing.hpp"
#include "layers/growth.hpp"

namespace lamina::pipeline {

/// Returns, for each element, the first height with which its largest skin friction has this y+. Precondition: the flow
/// has boundary layers.
std::vector<double> first_heights_of_flow(const Flow& flow, double y_plus, double reynolds);

/// Returns, for each element, the largest skin friction times the wall's density, both by the free stream. The wall is
/// adiabatic with a recovery factor of 0.89, the cube root of the Prandtl number. Empty without layers. Source: F. M.
/// White, Viscous Fluid Flow, 3rd ed. (2006), section 7-1.
std::vector<double> wall_frictions(const CompressibleFlow& flow);

/// Layers are this many times as thick as the boundary layer, which solvers find up to a fifth thicker. Some of it is
/// lost where the front is smoothed.
inline constexpr double room_above = 1.35;

/// Returns the heights that layers need along the walls: those of the boundary layers and some room above, never less
/// than further upstream.
std::vector<layers::WallHeight> heights_of_flow(const Flow& flow);

/// Returns spacings of the walls with which the speed of the flow changes little from one vertex to the next: at the
/// stagnation point, and on both sides of a suction peak. Spacings at the corners of bases follow from the first
/// heights. All others are divided by LayerGrowth::fineness.
std::vector<geometry::WallSpacing> spacings_of_flow(const Flow& flow, const layers::LayerGrowth& growth);

/// Returns the smallest of these spacings on each resampled element.
std::vector<FlowSpacing> smallest_spacings(std::span<const geometry::WallSpacing> spacings, const Geometry& geometry);

/// A source of the size field on a part of a wake.
struct WakeSource {
    double begins;  ///< distance of its beginning from the trailing edge, along the wake
    SizeSource source;
};

/// A wake, and the sources of the size field along it.
struct ElementWake {
    FlowWake wake;
    std::vector<Point> line;        ///< the streamline, from the trailing edge or the middle of its base on
    std::vector<WakeSource> outer;  ///< over the whole wake
    std::vector<WakeSource> inner;  ///< over the thinner wake within it, next to the trailing edge
    /// Over the mixing layers from both corners of a wide base, up to where they meet. The inner wake begins there.
    std::vector<WakeSource> mixing;
};

/// Returns the wakes of all elements: along the streamline behind each trailing edge, as fine as the wake is wide there
/// divided by a number of triangles. The streamline is that of a flow with less lift than potential flow has. A wake
/// ends where it would enter another body. Sizes are divided by CaseOptions::fineness.
std::vector<ElementWake> wakes_of_flow(const Flow& flow, double fineness = 1);

/// Adds the sources of a wake at another angle of attack to those of an element.
void add_to_fan(const ElementWake& wake, ElementWake& fan);

/// Adds sources between the wakes of an element at neighbouring angles of attack to its fan, where there is a gap.
void close_gap(const ElementWake& wake, const ElementWake& next, ElementWake& fan);

/// The flow before the mesh, and what follows from it beside the growth of the layer.
struct FlowGuidance {
    std::optional<Flow> flow;                      ///< none: nobody asked for it
    std::optional<CompressibleFlow> compressible;  ///< beyond the critical Mach number, at the same angle as `flow`
    std::vector<ElementWake> wakes;                ///< one per element or none
    std::vector<geometry::WallSpacing> spacings;
    std::vector<SizeSource> sources;     ///< along shocks
    std::vector<FlowShock> shocks;       ///< beyond the critical Mach number
    bool knows_shocks = false;           ///< FlowDecisions::knows_shocks
    std::vector<double> frictions;       ///< FlowDecisions::frictions
    std::vector<AngleDecisions> angles;  ///< FlowDecisions::angles
};

/// Solves the flow round these bodies between the walls of the domain. Its first heights for the y+ of the options, its
/// least heights and wakes go to `growth`. Beyond the critical Mach number it solves the compressible flow, too, takes
/// first heights from its layers if it has any, and makes walls and sizes fine at shocks. For several angles of attack
/// the mesh gets the smallest of their first heights and spacings, the largest of their least heights, and the fan of
/// their wakes.
FlowGuidance guide_by_flow(const Geometry& geometry, const FlowWalls& walls, const FlowConditions& flow_conditions,
                           const LayerOptions& options, const ReferenceConditions& conditions,
                           layers::LayerGrowth& growth);

/// Returns the lines for layers that go on along these wakes, with heights that hold half of the wake and the boundary
/// layers of the trailing edges. `heights` are those of heights_of_flow().
std::vector<layers::WakeLine> wake_lines(const Flow& flow, std::span<const ElementWake> wakes,
                                         std::span<const layers::WallHeight> heights);

}  // namespace lamina::pipeline
