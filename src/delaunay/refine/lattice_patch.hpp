// Patches of lattice triangles, made from the vertices of one level's lattice.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "core/edge_links.hpp"

#include "delaunay/refine/lattice_grid.hpp"

namespace lamina::delaunay {

/// Triangulated patches strictly inside a region. Round each patch stands a collar, one row of loose lattice points.
/// The seam is what lies between the patches and the border of the region; the collar is in it. Smoothing may move it.
struct LatticePatches {
    std::vector<Point> points;
    std::vector<Triangle> triangles;   ///< equilateral up to rounding, counter-clockwise; they index points
    std::vector<Segment> boundary;     ///< the boundary of the patches, with the seam on its left; indexes points
    std::vector<VertexId> collar;      ///< the points that belong to the seam alone
    bool linked = false;               ///< whether the next two members are filled
    core::EdgeLinks links{};           ///< the neighbours of the triangles; no_link on the boundary
    core::EdgeLinks boundary_links{};  ///< for each segment of the boundary the edge of the patch behind it
    bool empty() const { return triangles.empty(); }
};

/// The points of patches that the seam shares: those on the boundary, then the collar.
struct SharedPatchPoints {
    std::vector<Segment> boundary;       ///< LatticePatches::boundary in the numbers of the seam
    std::vector<VertexId> patch_points;  ///< for each shared point its index in LatticePatches::points
    std::size_t boundary_points = 0;     ///< how many of them are on the boundary
};

/// Appends the points that the seam shares with its patches to the points of the seam.
SharedPatchPoints append_shared_points(const LatticePatches& patches, std::vector<Point>& seam_points);

/// The vertices of a level's patch.
struct PatchVertices {
    std::vector<LatticeWord> centres;  ///< vertices whose six triangles all belong to the patch
    std::vector<LatticeWord> all;      ///< the centres and their neighbours
};

/// Removes the vertices of the grid that lie in no hexagon of vertices with sides of two edges (a morphological
/// opening), so that neither thin fingers nor crumbs are left, and peels the collar off. Afterwards the grid holds the
/// vertices of the patch and of the collar. Returns those of the patch.
PatchVertices open_patch(LatticeGrid& grid);

/// Appends the vertices of the grid, and the triangles, boundary and collar of its patch.
void append_patch(const LatticeGrid& grid, const PatchVertices& patch, LatticePatches& patches);

}  // namespace lamina::delaunay
