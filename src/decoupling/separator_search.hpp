// The search for a straight separator that cuts a subdomain in two.
#pragma once

#include <optional>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "decoupling/border_triangulation.hpp"
#include "decoupling/line_border.hpp"

namespace lamina::decoupling {

/// A line between two vertices of a border.
struct Separator {
    LoopVertex from, to;
    std::size_t vertices = 0;       ///< number of vertices inside it
    std::vector<Point> interior{};  ///< these, where they are known
};

/// The estimated work of a subdomain, and a good separator if one was looked for and found.
struct SearchResult {
    std::optional<WorkEstimate> estimate;  ///< where this process has searched it
    double work = 0;                       ///< the number of triangles, about; all processes know the same
    std::optional<Separator> separator = {};
    unsigned process = 0;  ///< that has searched it
};

/// Estimates the work of a subdomain and, where it is more than about 1.5 x `pieces_target` triangles, looks for a good
/// separator. In a border of several loops it joins two of them, otherwise it divides the work as evenly as possible.
/// A separator is good if
/// - it leaves the border at 60 degrees or more at both ends,
/// - it has four segments or more, or eight where it joins loops,
/// - its first and last segments are about as long as the border edges beside them,
/// - the diametral circles of its segments hold no vertex of the border, and
/// - its own vertices lie neither in diametral circles of border edges nor close to vertices of the border.
SearchResult search_separator(LocalBorder border, const SizeField& size, double pieces_target);

}  // namespace lamina::decoupling
