// Division of the plane by lines through segments, so that most segments lie on one side of each line.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay::pieces {

/// The number of a part: a part comes before the parts inside it, and these follow each other.
using Part = std::uint8_t;

/// A binary tree of parts of the plane. A line through a segment divides a part into the points on its right, on its
/// left, and on the line, which belong to the part itself. Signs are rounded, since any division will do.
/// Source: H. Fuchs, Z. M. Kedem, B. F. Naylor, On visible surface generation by a priori tree structures, SIGGRAPH
/// (1980); the lines are those of segments (autopartition).
class LinePartition {
public:
    /// Chooses lines of `sample` that divide the sample evenly and cross few of its segments.
    LinePartition(std::span<const Point> points, const std::vector<Segment>& sample);

    std::size_t size() const { return parts_.size(); }
    bool is_divided(Part part) const { return parts_[part].sides[1] != 0; }
    Part low(Part part) const { return parts_[part].sides[0]; }
    Part high(Part part) const { return parts_[part].sides[1]; }
    /// Returns the number behind those of all parts inside a part.
    Part end(Part part) const { return parts_[part].end; }
    /// Returns whether a part is another one or lies inside it.
    bool is_within(Part part, Part outer) const { return outer <= part && part < parts_[outer].end; }
    /// Returns the smallest part that holds both.
    Part common(Part p, Part q) const { return common_[p * parts_.size() + q]; }

    Part of_point(Point p) const;
    /// Returns the part of a segment between points of these parts. A point on the line of a part belongs to whatever
    /// side the other one is on.
    Part of_segment(Part a, Part b) const;
    /// Returns the part of a triangle with vertices in these parts. One of them may lie on the line of a larger part
    /// and belong to whatever side the others are on.
    Part of_triangle(Part a, Part b, Part c) const;

private:
    struct Node {
        Point a, b;              ///< the line runs from a to b
        Part sides[2] = {0, 0};  ///< the parts on the right and on the left of it; 0 if the part is not divided
        Part end = 0;
    };

    void divide(std::span<const Point> points, const std::vector<Segment>& sample, unsigned depth);

    std::vector<Node> parts_;
    std::vector<Part> common_;
};

}  // namespace lamina::delaunay::pieces
