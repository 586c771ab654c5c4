// Which vertices of an outline are corners of the body, and which are samples of a smooth curve.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::surface {

/// Exterior angle at every vertex of a closed outline, in radians, positive where it turns left. In parallel order.
std::vector<double> turnings(std::span<const Point> outline);

/// Indices of the corners, ascending. A vertex is a corner where the outline turns far more than beside it:
///
///     \                          ____            a: the trailing edge; its neighbours hardly turn
///       \___ c ___            b |    |           b: two corners beside each other: a base
///                 --- a         |    |           c: a kink between straight neighbours
///
/// A round nose turns by as much at one vertex where it is sampled coarsely, but then its neighbours turn, too: on a
/// parabola by 0.3 times what is missing to 180 degrees. So neighbours count as straight where they turn by less than
/// 0.2 times the vertex's angle, or what is missing, if that is less. Beyond 125 degrees nothing tells how round the
/// body is between the samples: a corner. So are all vertices of a coarse polygon, a box or a hexagon.
std::vector<std::size_t> find_corners(std::span<const Point> outline);

}  // namespace lamina::surface
