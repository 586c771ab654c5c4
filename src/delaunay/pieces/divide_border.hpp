// Division of the border of a piece by a dividing path.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "delaunay/pieces/cut_line.hpp"
#include "delaunay/pieces/piece.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::delaunay::pieces {

/// The border of one of the two parts into which a path divides a piece.
struct HalfBorder {
    std::vector<BorderEdge> edges;
    std::vector<char> has_path_vertex;  ///< for each vertex of the path: whether it belongs to this part
};

/// The borders of both parts: `low` lies on the left of the path.
struct DividedBorder {
    HalfBorder low, high;
};

/// Divides a border along a path. The path is trimmed to the region: its edges outside of the region or along the
/// border divide nothing, and path vertices between two of those edges belong to a part only if they are on its border.
/// Returns nothing where an edge of the border crosses the path or runs through one of its vertices. Source:
/// thesis 6.7. Precondition: every point of the piece lies inside its border or on it.
std::optional<DividedBorder> divide_border(const SortedPoints& sorted, std::span<const BorderEdge> border,
                                           std::span<const Index> path, CutLine cut);

}  // namespace lamina::delaunay::pieces
