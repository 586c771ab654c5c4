// Faces of a planar straight-line subdivision.
#pragma once

#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::outer {

/// A face by the directed edges round it, the face on their left: one loop after the other, the outer one first.
struct Face {
    std::vector<Segment> edges;
};

/// Faces left of the directed edges, which meet at end points only. An edge with a face on both sides stands in both
/// directions. Loops that lie inside a face without touching its outer loop become holes of that face; the unbounded
/// face is left out. Faces are ordered by their lowest-numbered edge in `edges`. O(n log n), plus holes x faces.
std::vector<Face> trace_faces(std::span<const Point> points, std::span<const Segment> edges);

}  // namespace lamina::outer
