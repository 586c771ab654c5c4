// The rays of one element: where they start and which way they go.
#pragma once

#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/directions/outline_kind.hpp"
#include "layers/growth.hpp"
#include "layers/stages.hpp"
#include "layers/wake/wake_outline.hpp"

namespace lamina::layers {

/// Returns the rays of one counter-clockwise outline in the order of the wall: the bisector at each vertex, or a
/// fan at a sharp corner, and refining rays on the edges between, so that neighbours diverge by at most
/// options.max_ray_angle_deg, on jagged outlines by at most max_jagged_ray_angle_deg. The vertices of the outline
/// are origins exactly; the rays of a fan have one origin. On smooth outlines, blunter corners have fans, too:
/// refining rays would divide the edges beside them into far shorter ones. Vertices of a wake have one ray on
/// either side, and its edges no refining rays, so that both sides keep the same vertices. Refining rays stand
/// where `place_on_wall` says. With heights of the front, one per vertex, rays lean (leans.hpp). With
/// options.equal_fans all fans have one number of rays, only sharp corners have them, and there are no refining
/// rays. Source: thesis 3 and 3.1.
std::vector<RayLine> make_rays(std::span<const RayVertex> outline, OutlineKind kind, const LayerOptions& options,
                               const LayerGrowth& growth, std::span<const double> heights = {},
                               const PlaceOnWall& place_on_wall = {});

/// Adds the rays of a vertex of a straight wall along the lines that end there, and rays between, so that neighbours
/// differ by at most this angle, in radians. Precondition: feet is not empty.
void add_rays_along_lines(Point at, Point normal, std::span<const LineFoot> feet, double max_angle,
                          std::vector<RayLine>& rays);

}  // namespace lamina::layers
