// The geometry of two segments that cross: whether they do, where, and which of their ends divide the other.
#pragma once

#include <lamina/point.hpp>

namespace lamina::delaunay {

/// Returns whether v divides a-b into two shorter edges, up to rounding.
bool shortens(Point a, Point b, Point v);

/// Returns whether the insides of p-q and r-s have one point in common. Exact.
bool cross_properly(Point p, Point q, Point r, Point s);

/// Returns the crossing of p-q and r-s, rounded along p-q, but within the boxes of both. Coordinates below the range of
/// exact predicates are rounded to 0 or to its lower end.
Point crossing_point(Point p, Point q, Point r, Point s);

}  // namespace lamina::delaunay
