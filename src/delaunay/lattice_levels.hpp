// The edge lengths that lattices come in.
#pragma once

#include <vector>

namespace lamina::delaunay {

/// Lattice edges are at most this share of h. Triangles with edges of 1 h would just obey the size bound wherever they
/// lie; the remaining 3 % let refinement close the seams beside them (docs/decisions/0002).
inline constexpr double lattice_share = 0.97;
/// The ratio of the edge lengths of successive levels: sqrt(4/3), a third in area.
inline constexpr double level_ratio = 1.1547005383792517;
/// Blocks of fewer lattice edges across are not worth a patch.
inline constexpr double min_block_edges = 6;

/// A bin of a histogram of triangles by size.
struct SizeBin {
    double low, high;  ///< the sizes h in the bin
    double triangles;  ///< the number of triangles of these sizes, about
};

/// Returns the edge lengths of the levels for sizes from `low` to `high`, ascending. Level l serves the sizes from
/// edges[l] to edges[l + 1], divided by lattice_share. The lattice of a level fits best at the lower end of its sizes,
/// so one level begins at the one size that most triangles have, as in a box, in a disc or under a largest size;
/// without such a size, the first level begins at `low`.
std::vector<double> level_edges(double low, double high, std::vector<SizeBin> bins);

/// Returns the level that serves a size; -1 for sizes below the first level.
int level_of(double size, const std::vector<double>& edges);

}  // namespace lamina::delaunay
