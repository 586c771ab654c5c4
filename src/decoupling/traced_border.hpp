// The borders of regions between edges: how they are traced.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::decoupling {

/// The border of a region as it is traced, with the region on the left of every loop: the outer loop first, then its
/// holes. Each loop holds the numbers of its edges. It runs along both sides of an edge that dangles in the region.
struct TracedBorder {
    std::vector<std::vector<std::uint32_t>> loops;
};

/// Returns the borders of the regions on the left of directed edges, which meet at end points only. An edge between two
/// subdomains stands in both directions. Loops inside a subdomain that do not touch its outer loop become holes of it.
/// The unbounded region is left out. Borders are ordered by their lowest-numbered edge, which begins a loop. O(n log
/// n), plus holes x subdomains.
std::vector<TracedBorder> trace_borders(std::span<const Point> points, std::span<const Segment> edges);

}  // namespace lamina::decoupling
