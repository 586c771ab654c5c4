// The parts that segments cut a constrained triangulation into, the borders between them, and the sharp corners of
// these borders.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/point.hpp>

#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

/// A segment of the triangulation, or an edge of its boundary that is no segment, with the vertices that split it.
struct PartBorder {
    std::vector<Index> chain;  ///< the vertices from one end to the other
    std::vector<Index> parts;  ///< the parts beside it; the same one twice if the border dangles inside a part
};

/// A border from the side of one part.
struct PartSide {
    Index border;
    bool forward;  ///< whether the part lies on the left of the border's chain
};

/// Triangles that can be reached from each other without crossing a border.
struct ConstrainedPart {
    std::vector<PartSide> sides;
    std::vector<Index> vertices;  ///< the vertices that the triangulation has in it, ascending
    const SizeField* size = nullptr;
    std::uint32_t region = ConstrainedRefinement::no_region;
    bool stale = true;  ///< whether a border was split since the part was refined
};

/// Borders u-v and u-w that meet at less than 60 degrees. The part between them lies counter-clockwise from v to w.
struct SharpCorner {
    Index u, v, w;
};

/// One edge of the chain of a border: from vertex `place` of the chain to the next one.
struct Subsegment {
    Index border;
    std::size_t place;
    friend bool operator==(const Subsegment&, const Subsegment&) = default;
};

/// A part's points and segments, numbered for the part alone.
struct LocalPart {
    std::vector<Index> global;  ///< for each point its index in ConstrainedParts::points, ascending
    std::vector<Point> points;
    std::vector<Segment> segments;        ///< the part lies on their left
    std::vector<Subsegment> subsegments;  ///< for each segment the subsegment that it is
};

/// A constrained triangulation as parts and borders.
struct ConstrainedParts {
    std::vector<Point> points;            ///< those of the triangulation, then those that split borders
    std::vector<Index> border_of_vertex;  ///< for each point the border that it splits; no_index for the others
    std::vector<PartBorder> borders;      ///< the segments in their order, then the other boundary edges
    std::vector<ConstrainedPart> parts;
    std::vector<char>
        acute;  ///< for each vertex of the triangulation: whether borders meet there at less than 90 degrees
    std::vector<SharpCorner> sharp_corners;  ///< sorted by u
    std::vector<std::uint64_t> sharp_pairs;  ///< undirected_key() of the two borders at each sharp corner, sorted

    /// Returns whether p lies in a sharp corner at vertex u. Exact.
    bool in_sharp_corner(Index u, Point p) const;
    /// Returns whether two borders make a sharp corner.
    bool meet_sharply(Index border_a, Index border_b) const;
    /// Returns a part with the subsegments that its borders consist of by now.
    LocalPart localize(const ConstrainedPart& part) const;
};

/// Finds the parts of a triangulation of these points. A part gets the size field of the first region whose seed it
/// holds, or else `size`. The result refers to the size fields.
ConstrainedParts find_parts(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                            const SizeField& size, std::span<const RegionSize> regions);

}  // namespace lamina::delaunay
