// New vertices on edges of the boundary of a mesh that is made.
#pragma once

#include <span>
#include <vector>

#include <lamina/pipeline.hpp>

namespace lamina::pipeline {

/// An edge of a marker, the mesh on its left, and new vertices on it, in their order.
struct DividedEdge {
    Segment edge;
    std::vector<Point> at;
};

/// Divides edges of the boundary, and the cells beside them, which become triangles of the same layer and column. The
/// triangles of the layer stay the first ones. Precondition: each edge is one of a marker that is not internal.
void divide_boundary(std::span<const DividedEdge> edges, MeshResult& result);

}  // namespace lamina::pipeline
