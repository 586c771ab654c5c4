// Patches of equilateral lattice for the smooth inside of large regions.
#pragma once

#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina::delaunay {

/// Lattice edges are at most this share of h. Below 1, triangles of them obey the size bound wherever they lie; what is
/// missing to 1 lets refinement close the seams beside them (docs/decisions/0002).
inline constexpr double lattice_share = 0.97;
/// Ratio of the edge lengths of successive levels: sqrt(4/3), a third in area.
inline constexpr double level_ratio = 1.1547005383792517;
/// Blocks of fewer edges across are not worth a patch.
inline constexpr double smallest_block = 6;

/// Where sizes are from low to high, about so many triangles.
struct SizeCount {
    double low, high, triangles;
};

/// Edge lengths of the levels for sizes from `low` to `high`: level l serves sizes from edges[l] to edges[l + 1]
/// (divided by lattice_share). The foot of a level, where its lattice fits best, is at the one size that most triangles
/// have: in a box, a disc or under a cap; at `low` where there is none.
std::vector<double> level_edges(double low, double high, std::vector<SizeCount> counts);
int level_of(double size, const std::vector<double>& edges);

/// Triangulated patches strictly inside a region, and the collar of loose lattice points round each of them; what lies
/// between the patches and the border is the seam.
struct LatticePatches {
    std::vector<Point> points;
    std::vector<Triangle> triangles;  ///< equilateral up to rounding, counter-clockwise, into points
    std::vector<Segment> rim;         ///< border of the patches, the seam on the left, into points
    std::vector<VertexId> collar;     ///< points that belong to the seam alone
    bool empty() const { return triangles.empty(); }
};

/// Fills the region left of `segments` with patches wherever the size field is so even that a patch pays; empty where
/// it does not, or would go far beyond `max_points`. Triangles obey the size bound of refine(). Collars keep the
/// distance of about a lattice row from the border and from each other. Rim edges are longer than frozen edges may be
/// (0.93 h): it is the collar, one row of points that refinement may connect as it likes, that keeps new points away
/// from them.
LatticePatches fill_with_lattice(std::span<const Point> points, std::span<const Segment> segments,
                                 const SizeField& size, std::size_t max_points);

}  // namespace lamina::delaunay
