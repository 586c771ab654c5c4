// The line along which the wake of an element lies on a triangulation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "flow/euler/dual_mesh.hpp"
#include "flow/euler/gas.hpp"
#include "flow/euler/triangles_at_edges.hpp"

namespace lamina::flow::euler {

/// A point of the line: where it crosses an edge.
struct WakePoint {
    std::uint32_t a, b;  ///< ends of the edge
    double share;        ///< of b
    Point at;            ///< the point
};

/// The triangles of a dual mesh, by the numbers of its vertices.
struct NumberedTriangles {
    std::vector<Triangle> triangles;
    TrianglesAtEdges at_edges;
};

NumberedTriangles numbered_triangles(const DualMesh& mesh, std::span<const Triangle> triangles);

/// The point and the direction in which the line of a wake leaves its element.
struct WakeStart {
    std::vector<std::uint32_t>
        corners;      ///< the trailing edge, or the vertices of the base from the lower to the upper side
    Point at;         ///< the trailing edge, or the middle of the base
    Point direction;  ///< unit vector along the bisector of the sides
};

/// Returns the crossings of the line with the edges of the triangulation over a length, without its start. It leaves as
/// WakeStart says, over the distance `near`, within which velocities are not those of the wake, and then follows the
/// velocities, triangle by triangle. It ends early at a boundary.
///
///          b ______ third          The line enters the triangle across the edge from a, on its right hand, to b, on
///           \  ___x                its left, and leaves across the edge at the third vertex that it meets.
///     -------\x   /
///             \  /
///              a
std::vector<WakePoint> trace_wake(const DualMesh& mesh, const NumberedTriangles& triangles,
                                  std::span<const Four> states, const WakeStart& start, double length, double near);

}  // namespace lamina::flow::euler
