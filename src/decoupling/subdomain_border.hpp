// The borders of subdomains as loops of vertices: how they are traced, split and joined.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::decoupling {

/// The border of a subdomain, with the subdomain on the left of every loop: the outer loop first, then its holes. A
/// loop runs along both sides of an edge that dangles in the subdomain and then holds its vertices twice.
struct SubdomainBorder {
    std::vector<std::vector<VertexId>> loops;
    bool may_dangle = false;  ///< whether loops were joined, so that edges may dangle
};

/// A vertex of a border, given by its loop and its index in the loop. A vertex that the border holds twice has two of
/// these.
struct LoopVertex {
    std::size_t loop, index;
};

/// A border whose vertices are numbered by themselves, from 0 on.
struct LocalBorder {
    std::vector<VertexId> global;   ///< the ids of its vertices, ascending
    std::vector<Point> points;      ///< their coordinates
    std::vector<Segment> segments;  ///< the edges of all loops, loop by loop, between indices into points
};

/// Numbers the vertices of a border in ascending order of their ids. `points` holds them by their ids.
LocalBorder localize(const SubdomainBorder& border, std::span<const Point> points);

/// Returns the borders of the regions on the left of directed edges, which meet at end points only. An edge between two
/// subdomains stands in both directions. Loops inside a subdomain that do not touch its outer loop become holes of it.
/// The unbounded region is left out. Borders are ordered by their lowest-numbered edge in `edges`. O(n log n), plus
/// holes x subdomains.
std::vector<SubdomainBorder> trace_borders(std::span<const Point> points, std::span<const Segment> edges);

/// The two parts of a border that was split.
struct BorderHalves {
    SubdomainBorder first, second;
};

/// Splits a border of one loop along a line between two of its vertices, given by their indices. `line` holds the
/// vertices inside the line.
///
///       o------ to -----o
///       |        :      |        The first part has the line in its direction, the second part in the opposite one.
///       | first  : second
///       |        :      |
///       o----- from ----o
BorderHalves split(const SubdomainBorder& border, std::size_t from, std::size_t to, std::span<const VertexId> line);

/// Joins two loops of a border along a line between them: the new loop runs along both sides of the line. `line` holds
/// the vertices inside the line.
///
///       o----------------o
///       |          o---o |
///       to :::: from   | |        The border has one hole less.
///       |          o---o |
///       o----------------o
SubdomainBorder join(const SubdomainBorder& border, LoopVertex from, LoopVertex to, std::span<const VertexId> line);

}  // namespace lamina::decoupling
