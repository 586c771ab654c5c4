// Trailing edges whose surfaces cross.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/source_point.hpp"

namespace lamina::geometry {

/// The place where a tail was cut.
struct TailCut {
    Point at;                                ///< the crossing, the new trailing edge
    bool at_vertex = false;                  ///< the surfaces meet at a vertex, instead of crossing between vertices
    double share = 0;                        ///< length of the tail behind it, as a share of the section's extent
    std::vector<std::size_t> removed_lines;  ///< lines of the points that were cut off, ascending
};

/// Cuts a tail off at the point where the two surfaces cross, which becomes the first point:
///
///     ---___                          ---___
///           \><=== rearmost   ->            >  crossing
///     ___---/                         ___---/
///
/// A tail is cut only if it holds the rearmost vertex and none of it lies farther from the crossing than 2 % of the
/// section's extent. Seven sections of the UIUC collection cross in the last 0.1 to 1.7 %; others cross at
/// the nose or at two thirds of the chord. Where the surfaces cross more than once, the crossing farthest from the tail
/// counts. The outline may be open: the edge from its last point to its first one counts, too. Returns nothing where no
/// crossing was found.
std::optional<TailCut> cut_crossing_tail(std::vector<SourcePoint>& points);

}  // namespace lamina::geometry
