// Linked triangles from plain ones.
#pragma once

#include <span>

#include <lamina/ids.hpp>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Returns the triangles with links to their neighbours, in the same order. Edges without a neighbour are borders; the
/// segments, which are edges, are constrained. Precondition: no edge is used twice in the same direction.
Tris link_triangles(std::span<const Triangle> triangles, std::span<const Segment> segments);

}  // namespace lamina::delaunay
