// The edge lengths that lattices come in.
#pragma once

#include <vector>

namespace lamina::delaunay {

/// Lattice edges have at most the first share of h, so that their mean is h where sizes pass through the levels. Those
/// that serve the commonest size have the second one: a little more than 1, which lets refinement close the seams
/// beside them without too many short edges.
inline constexpr double largest_lattice_share = 1.07, commonest_lattice_share = 1.02;
/// The edges of lattices have this share of the longest edge that a bound of the area admits, where the user gives one
/// (RefineOptions::max_area_ratio). A share near 1 makes few triangles; the rest lets refinement close the seams.
inline constexpr double largest_area_share = 0.97;
/// The ratio of the edge lengths of successive levels: sqrt(4/3), a third in area.
inline constexpr double level_ratio = 1.1547005383792517;
/// Blocks of fewer lattice edges across are not worth a patch.
inline constexpr double min_block_edges = 6;

/// A bin of a histogram of triangles by size.
struct SizeBin {
    double low, high;  ///< the sizes h in the bin
    double triangles;  ///< the number of triangles of these sizes, about
};

/// The edge lengths of lattices, by level.
struct LatticeLevels {
    std::vector<double> edges;             ///< ascending by level_ratio
    double share = largest_lattice_share;  ///< level l serves the sizes from edges[l] to edges[l + 1], divided by this

    /// Returns the level that serves a size; -1 for sizes below the first level.
    int level_of(double size) const;
    /// Returns the smallest size that a level serves.
    double smallest_size(std::size_t level) const { return edges[level] / share; }
};

/// Returns the levels for sizes from `low` to `high`. The lattice of a level fits best in the lower part of its sizes,
/// so one level suits the one size that most triangles have, as in a box, in a disc or under a largest size; without
/// such a size, the first level begins at `low`. Triangles keep the bound of their area.
LatticeLevels lattice_levels(double low, double high, double max_area_ratio, std::vector<SizeBin> bins);

}  // namespace lamina::delaunay
