// The corners of an outline, told apart from samples of a smooth curve.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/point.hpp>

#include "geometry/trailing_edge.hpp"

namespace lamina::surface {

using geometry::turning_angles;

/// Returns the indices of the corners of a closed outline, ascending. A vertex is a corner where the outline turns far
/// more than beside it:
///
///     \                          ____            a: a trailing edge; its neighbours hardly turn
///       \___ c ___            b |    |           b: two corners beside each other: a base
///                 --- a         |    |           c: a kink between straight neighbours
///
/// A round nose that is sampled coarsely turns by as much at one vertex, but then its neighbours turn, too: on a
/// parabola by 0.3 times the vertex's angle to 180 degrees. A neighbour therefore counts as straight where it turns by
/// less than 0.2 times the vertex's angle, or by less than 0.2 times the rest to 180 degrees if that is less. Beyond
/// 125 degrees a vertex is a corner, unless its neighbours turn on by 5 to 60 degrees and the thickness grows like that
/// of a parabola: as the distance to a power of 0.35 to 0.75.
///
/// Corners are also all vertices of a coarse polygon, such as a box, a hexagon or a snowflake; those between two sides
/// that are longer than 0.35 of the outline, where it turns by more than one degree; and the first and the last vertex,
/// if they end the chord, turn by more than 60 degrees and are no such nose (docs/decisions/0009).
std::vector<std::size_t> find_corners(std::span<const Point> outline);

/// Returns whether a point is one of the corners that an element brings along (Element::given_corners).
bool is_given_corner(const Element& element, std::size_t point);

/// Returns the same corners of an element, and those that it brings along.
std::vector<std::size_t> find_corners(const Element& element);

}  // namespace lamina::surface
