// Lines that continue one another straight on.
#pragma once

#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Returns for each line the first line of its chain. Lines that meet at a vertex belong to one chain if they are
/// pieces of the same segment, or if the vertex lies between their other ends within unresolved_distance() of either.
/// `parents` are the segments that the first lines are pieces of; the others are pieces of none.
///
///     a-----u-----b      a-u and u-b are one chain, and c meets it at u: a small angle there is that of c-u with the
///           '-._         whole chain, wherever u divides it.
///               c
///
/// At a vertex each line continues one other at most.
std::vector<Index> straight_chains(std::span<const Point> points, std::span<const Segment> lines,
                                   std::span<const Index> parents, std::span<const double> unresolved_distances);

}  // namespace lamina::delaunay
