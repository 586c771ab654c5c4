// The lines between subdomains while they are being drawn.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/connected_ranks.hpp"
#include "decoupling/far_field.hpp"
#include "decoupling/line_border.hpp"
#include "decoupling/lines.hpp"
#include "decoupling/ring_regions.hpp"
#include "decoupling/traced_border.hpp"

namespace lamina::decoupling {

/// All lines before anything is cut to size, and where they meet.
class Skeleton {
public:
    /// Begins with these points, which must outlive the lines (Lines).
    explicit Skeleton(std::span<const Point> points) : lines(points) {}

    Lines lines;

    /// Adds a vertex where lines meet. Precondition: no vertices of lines are numbered yet.
    VertexId add_junction(Point p) { return lines.add_junction(p); }
    /// Adds a closed line along vertices that exist, with the region on its left.
    void add_loop(std::span<const VertexId> loop);
    /// Adds a closed line along new vertices, with the region on its left. Returns its number.
    std::uint32_t add_new_loop(std::vector<Point> loop);
    /// The sides of a line on which there are regions to trace. Regions of rings are no such.
    struct Sides {
        bool left = false, right = false;
    };
    /// Adds a straight line between two junctions. Returns its number.
    std::uint32_t add_line(VertexId from, VertexId to, std::uint32_t min_segments, Sides traced);
    /// Adds a row of lines. Returns the number of the first one.
    std::uint32_t add_row(const LineRow& row, Sides traced);

    /// The regions between lines of which the borders follow from numbers.
    RingRegions rings;

    /// Returns the borders of all other regions between the lines, once all vertices are numbered. Takes time in
    /// proportion to the lines and not to their vertices.
    std::vector<LineBorder> trace();
    /// Collective: numbers the vertices inside all straight lines. A process divides the lines of those trapezoids
    /// that it will search, so far as no process before it does.
    void number_together(const SizeField& size, core::ConnectedRanks& ranks);

private:
    /// A line as an edge between corners, in one direction: a whole straight line, or a segment of a closed one.
    struct Edge {
        std::uint32_t line = 0, place = 0;
        bool forward = true;
    };
    std::vector<Point> corners_;
    std::unordered_map<std::uint32_t, VertexId> corner_of_;  ///< of vertices at the ends of edges
    std::vector<Segment> ends_;                              ///< of the edges, in corners_
    std::vector<Edge> edges_;
    VertexId corner(VertexId vertex);
    void trace_line(std::uint32_t line, VertexId from, VertexId to, Sides traced);
    LineLoop loop_of(std::span<const std::uint32_t> edges) const;
};

/// Returns the edges along a whole line.
std::vector<Segment> edges_along(const Lines& lines, std::uint32_t line);

/// Adds the outline of a far field that is no box. Returns its edges, with the region on their left.
std::vector<Segment> add_far_field_outline(Skeleton& skeleton, const FarField& far_field, const SizeField& size);

}  // namespace lamina::decoupling
