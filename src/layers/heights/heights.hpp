// Columns: the heights of the layers on each ray, from what is asked for and from where the front is to lie.
#pragma once

#include <span>
#include <vector>

#include "layers/growth.hpp"
#include "layers/stages.hpp"
#include "layers/wake/wake_outline.hpp"

namespace lamina::layers {

// Heights that are given along walls.

/// Returns the height at the point of a closed chain that is nearest to p.
double height_at(Point p, std::span<const WallHeight> chain);

/// Sets the least heights of the vertices on the wall of an element: that of the nearest point of this closed chain,
/// linear along it. Those of wakes stay as they are.
void set_least_heights(std::span<const WallHeight> chain, std::span<RayVertex> outline);

/// Returns the first heights wanted at the vertices of the wall of an element: those of the nearest points of
/// LayerGrowth::wall_first_heights, so that neighbours differ by a tenth at most; empty where it has none there.
std::vector<double> first_heights_on_wall(const LayerGrowth& growth, std::size_t element, std::span<const Point> wall);

/// Gives the vertices of an outline on the wall these first heights, one per vertex of the wall, and those of a wake
/// the one at its beginning times what they have. `first_height` is that of the element.
void set_first_heights(std::span<const double> heights, std::span<const Point> wall, double first_height,
                       std::span<RayVertex> outline);

/// Returns the least heights of all rays. The ends of a fan have those of the rays beside it, so that both sides of a
/// trailing edge keep their own.
std::vector<double> least_heights(const RaySet& set);

/// Sets the slants of rays: RayLine::slant.
void set_slants(RaySet& set);

/// Returns the first height along a ray. first_height: that wanted above the wall.
inline double first_height_along(const RayLine& ray, double first_height) {
    return ray.slant * ray.opening * first_height;
}

/// Returns the first height along each ray.
std::vector<double> first_heights_along(const RaySet& set, const LayerGrowth& growth);

/// Returns the height along each ray at which the requested layers end where nothing is in their way: that of their
/// number, of their thickness, or of isotropy, and at least that of the flow's boundary layer. Throws OptionError where
/// more than 1000 layers would be needed up to isotropy. Precondition: slants are set.
std::vector<double> asked_heights(const RaySet& set, const LayerGrowth& growth);

/// Returns columns that end at `front`, which holds a height along each ray, at most the `asked` one. A ray whose front
/// is the asked one has the layers of a requested number as the growth law makes them. Other columns are stretched, and
/// their numbers of layers chosen so that neighbours differ by one at most and rarely. Throws OptionError as
/// asked_heights().
LayerHeights columns_up_to(const RaySet& set, const LayerGrowth& growth, std::span<const double> asked,
                           std::span<const double> front);

}  // namespace lamina::layers
