// The borders of subdomains as stretches of lines: how they are split and joined.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "decoupling/lines.hpp"

namespace lamina::decoupling {

/// A closed loop of stretches, each of which begins where the one before it ends.
struct LineLoop {
    std::vector<Stretch> stretches;
    std::size_t vertices = 0;  ///< their number, which is that of the segments

    void add(const Stretch& stretch) {
        stretches.push_back(stretch);
        vertices += stretch.segments();
    }
    friend bool operator==(const LineLoop&, const LineLoop&) = default;
};

/// The border of a subdomain, with the subdomain on the left of every loop: the outer loop first, then its holes. A
/// loop runs along both sides of an edge that dangles in the subdomain and then holds its vertices twice.
struct LineBorder {
    std::vector<LineLoop> loops;
    bool may_dangle = false;  ///< whether loops were joined, and a loop runs along a line in both directions still

    std::size_t vertices() const {
        std::size_t sum = 0;
        for (const LineLoop& loop : loops) sum += loop.vertices;
        return sum;
    }
};

/// A vertex of a border, given by its loop and its index in the loop. A vertex that the border holds twice has two of
/// these.
struct LoopVertex {
    std::size_t loop, index;
};

/// Returns the ids of the vertices of a loop in their order.
LAMINA_EXPORT std::vector<VertexId> ids_of(const LineLoop& loop, const Lines& lines);

/// Returns whether each stretch of a loop begins where the one before it ends. For assertions.
inline bool is_closed(const LineLoop& loop, const Lines& lines) {
    if (loop.stretches.empty()) return false;
    const Stretch* before = &loop.stretches.back();
    for (const Stretch& stretch : loop.stretches) {
        if (lines.id(before->line, before->last) != lines.id(stretch.line, stretch.first)) return false;
        before = &stretch;
    }
    return true;
}

/// Returns the vertex of a border at this place.
LineVertex vertex_of(const LineBorder& border, LoopVertex at, const Lines& lines);

/// A border whose vertices are numbered by themselves, from 0 on.
struct LocalBorder {
    std::vector<VertexId> global;    ///< the ids of its vertices, ascending
    std::vector<Point> points;       ///< their coordinates
    std::vector<Segment> segments;   ///< the edges of all loops, loop by loop, between indices into points
    std::vector<std::size_t> loops;  ///< the number of vertices of each loop
};

/// Numbers the vertices of a border in ascending order of their ids. Divides its lines.
LocalBorder localize(const LineBorder& border, Lines& lines, const SizeField& size);

/// The two parts of a border that was split.
struct BorderHalves {
    LineBorder first, second;
};

/// Splits a border of one loop along a line between two of its vertices, given by their indices.
///
///       o------ to -----o
///       |        :      |        The first part has the line in its direction, the second part in the opposite one.
///       | first  : second
///       |        :      |
///       o----- from ----o
BorderHalves split(const LineBorder& border, std::size_t from, std::size_t to, const Stretch& line);

/// Joins two loops of a border along a line between them: the new loop runs along both sides of the line.
///
///       o----------------o
///       |          o---o |
///       to :::: from   | |        The border has one hole less.
///       |          o---o |
///       o----------------o
LineBorder join(const LineBorder& border, LoopVertex from, LoopVertex to, const Stretch& line);

}  // namespace lamina::decoupling
