// Patches of equilateral lattice for the smooth inside of large regions.
#pragma once

#include <cstddef>
#include <span>

#include <lamina/delaunay.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "delaunay/refine/lattice_patch.hpp"

namespace lamina::delaunay {

/// A place that patches keep a distance from.
struct LatticeObstacle {
    Point at;
    double radius;
};

/// Fills the region on the left of the segments with patches wherever sizes are so even that a patch pays. Returns no
/// patches where none pays, or where they would go far beyond `options.max_points`. The triangles obey the size bound
/// of refine(). Where `linked`, they know their neighbours. Collars keep about the distance of a lattice row from the
/// border, from all points and from each other, and the radii of the obstacles from these. Boundary edges of patches
/// are longer than frozen edges may be. The collar, one row of points that refinement connects as it likes, keeps new
/// points away from them.
LatticePatches fill_with_lattice(std::span<const Point> points, std::span<const Segment> segments,
                                 const SizeField& size, const RefineOptions& options,
                                 std::span<const LatticeObstacle> obstacles = {}, bool linked = false);

}  // namespace lamina::delaunay
