// Leans: rays turn from the normals of the wall, so that columns are as wide at the front as their height needs.
//
//      _____                 ___
//     |||||||`.             ////|`-.
//     |||||||   \           ////|   `.         front
//     |||||||    |          ////|`.   |
//     |||||||____|          |///|__`.__\      corner with a fan of rays: without leans, and with them
//
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/directions/outline_kind.hpp"
#include "layers/growth.hpp"
#include "layers/wake/wake_outline.hpp"

namespace lamina::layers {

// The leans of all rays of an outline as one convex problem on a chain.

/// Bounds of the lean of a ray, in radians.
struct LeanBounds {
    double least, most;

    double clamped(double lean) const { return lean < least ? least : lean > most ? most : lean; }
};

/// The solution, and what it took.
struct ChainLeans {
    std::vector<double> leans;  ///< one per ray, in radians, counter-clockwise
    std::size_t steps = 0;      ///< of Newton's method
};

/// The lack of width of a column at the front, over the front's height: the angles, in radians, by which its rays
/// should diverge more than they do without leans. A column that lacks nothing has any negative number, down to minus
/// infinity.
struct ColumnLack {
    double wanted;  ///< for it to be as wide as columns should be
    double least;   ///< for its rays not to meet near the front
};

/// Returns the leans t within their bounds that minimise
///
///     sum (wanted - o)_+^2 + (least - o)_+^2 over columns  +  stiffness sum t^2 over rays,
///
/// where o = t_after - t_before is what the rays of a column diverge by. Column k lies between rays k and k + 1; the
/// first ray follows the last one. The function is strictly convex: there is one minimum, and mirrored input has
/// mirrored leans but for rounding. What is wanted is spread over about 1 / sqrt(stiffness) columns. Each step costs
/// O(n), since the Hessian is a cyclic tridiagonal M-matrix; a step that changes neither the terms that count nor the
/// leans that are held ends the search. Preconditions: at least three rays, one column and one pair of bounds for each,
/// least <= most, stiffness > 0.
/// Source: D. P. Bertsekas, Projected Newton methods for optimization problems with simple constraints, SIAM J. Control
/// Optim. 20 (1982), 221-246.
ChainLeans minimise_leans(std::span<const ColumnLack> lacks, std::span<const LeanBounds> bounds, double stiffness);

/// A line that ends at a vertex.
struct LineAtVertex {
    double angle;  ///< from the vertex's bisector to the line, in radians, counter-clockwise
    LineFoot foot;
};

/// A vertex of an outline with the outward normals round it.
struct WallVertex {
    double turning;       ///< angle between the two edges in radians; > 0 where the body is convex
    Point normal_before;  ///< outward unit normal of the edge that ends here
    Point normal_after;   ///< outward unit normal of the edge that begins here
    Point bisector;       ///< outward unit vector
    bool fan;             ///< whether it has several rays, from normal_before to normal_after; else one, the bisector
    double lean[2]{};     ///< angles by which the first and the last ray lean, in radians, counter-clockwise
    std::vector<LineAtVertex> lines{};  ///< those that end there, by their angles
};

/// Returns the bounds of the lean of the first ray of a fan, or of the last one. Those along lines do not lean.
/// Precondition: vertex.fan.
LeanBounds fan_bounds(const WallVertex& vertex, bool is_last);

/// Returns the angle to which columns of an outline may open without more rays, in radians:
/// LayerOptions::max_ray_angle_deg, or, where corners follow each other closely, max_jagged_ray_angle_deg if that is
/// more.
double most_opening(OutlineKind kind, const LayerOptions& options);

/// Sets the leans of all rays of an outline, where `heights` are those of the front at its vertices: those that the
/// chain problem asks for (minimise_leans()), from the bisectors, at fans from the normals of the edges. Rays lean by
/// no more than what keeps first heights above both edges, fans keep a part of their angle, and the ray at the end of a
/// wake does not lean. Sources: the problem is that of R. Aubry and R. Löhner, On the 'most normal' normal, Commun.
/// Numer. Meth. Engng 24 (2008), and V. Dyedov et al., Variational generation of prismatic boundary-layer meshes, Int.
/// J. Numer. Meth. Engng 79 (2009), whose energies of angles and edges become one of columns.
void lean_rays(std::span<const RayVertex> outline, std::span<const double> heights, OutlineKind kind,
               const LayerOptions& options, const LayerGrowth& growth, std::vector<WallVertex>& vertices);

}  // namespace lamina::layers
