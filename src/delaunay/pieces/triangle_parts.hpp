// TriangleParts of a triangulation into parts with short borders.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <lamina/point.hpp>

#include "delaunay/triangulate/growing.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay::pieces {

/// The parts of a triangulation, of about equally many triangles.
struct TriangleParts {
    std::vector<Index> order;        ///< the triangles, part by part
    std::vector<Index> place;        ///< for each triangle its place in `order`
    std::vector<Index> part;         ///< for each triangle its part
    std::vector<std::size_t> first;  ///< the place of the first triangle of each part, and the number of triangles
    Point direction;                 ///< along which the triangles are sorted, if they are
    std::vector<double> along;       ///< their coordinates in this direction, in their order; else nothing
    std::size_t size() const { return first.size() - 1; }
    /// Returns the index of a triangle within its part.
    Index within(Index t) const { return static_cast<Index>(place[t] - first[part[t]]); }
    bool is_border(Index t, Link n) const { return part[t] != part[n.triangle()]; }
    /// Returns a triangle at the place of a point in the direction. Precondition: `along` is not empty.
    Index near(Point p) const;
    /// Returns the part of this place. Precondition: as above.
    std::size_t part_near(Point p) const;
};

/// Returns so many parts, where a sixteenth of the triangles at most has a neighbour in another part; nothing where no
/// such parts were found. Precondition: the triangulation is not empty.
std::optional<TriangleParts> find_parts(const GrowingTriangulation& grown, std::size_t parts);

}  // namespace lamina::delaunay::pieces
