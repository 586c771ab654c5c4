// Leans: rays turn from the normals of the wall, so that columns are as wide at the front as their height needs.
//
//      _____                 ___
//     |||||||`.             ////|`-.
//     |||||||   \           ////|   `.         front
//     |||||||    |          ////|`.   |
//     |||||||____|          |///|__`.__\      corner with a fan of rays: without leans, and with them
//
#pragma once

#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/directions/outline_kind.hpp"
#include "layers/growth.hpp"
#include "layers/wake/wake_outline.hpp"

namespace lamina::layers {

/// A vertex of an outline with the outward normals round it.
struct WallVertex {
    double turning;       ///< angle between the two edges in radians; > 0 where the body is convex
    Point normal_before;  ///< outward unit normal of the edge that ends here
    Point normal_after;   ///< outward unit normal of the edge that begins here
    Point bisector;       ///< outward unit vector
    bool fan;             ///< whether it has several rays, from normal_before to normal_after; else one, the bisector
    double lean[2]{};     ///< angles by which the first and the last ray lean, in radians, counter-clockwise
};

/// Returns the angle to which columns of an outline may open without more rays, in radians: LayerOptions::max_ray_angle_deg, or,
/// where corners follow each other closely, max_jagged_ray_angle_deg if that is more.
double most_opening(OutlineKind kind, const LayerOptions& options);

/// Sets the leans of all rays of an outline, where `heights` are those of the front at its vertices: those that the chain
/// problem asks for (lean_chain.hpp), from the bisectors, at fans from the normals of the edges. Rays lean by no more than
/// what keeps first heights above both edges, fans keep a part of their angle, and the ray at the end of a wake does not lean.
/// Sources: the problem is that of R. Aubry and R. Löhner, On the 'most normal' normal, Commun. Numer. Meth. Engng 24 (2008),
/// and V. Dyedov et al., Variational generation of prismatic boundary-layer meshes, Int. J. Numer. Meth. Engng 79 (2009), whose
/// energies of angles and edges become one of columns.
void lean_rays(std::span<const RayVertex> outline, std::span<const double> heights, OutlineKind kind,
               const LayerOptions& options, const LayerGrowth& growth, std::vector<WallVertex>& vertices);

}  // namespace lamina::layers
